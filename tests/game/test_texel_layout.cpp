#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "wilt/core/error.hpp"
#include "wilt/game/texel_layout.hpp"

namespace wilt {
namespace {

bool power_of_two(int side) {
  return side > 0 && (side & (side - 1)) == 0;
}

// Oracle: property. Every vertex of every frame has a texel of its own inside the texture, and the lookup
// finds it.
TEST(TexelLayout, GivesEveryVertexItsTexel) {
  struct Case {
    int vertices, frames;
  };
  for (const auto& [vertices, frames] :
       {Case{1, 1}, Case{700, 26}, Case{8192, 3}, Case{8193, 3}, Case{20000, 100}}) {
    const TexelLayout layout = TexelLayout::make(vertices, frames);
    EXPECT_TRUE(power_of_two(layout.width) && layout.width <= 8192);
    EXPECT_TRUE(power_of_two(layout.height) && layout.height <= 8192);
    const Points2 lookup = layout.lookup(0, vertices);
    std::set<int> seen;
    for (int k = 0; k < frames; ++k)
      for (int i = 0; i < vertices; i += 1 + vertices / 100) {
        const int texel = layout.texel(i, k);
        EXPECT_TRUE(seen.insert(texel).second);
        EXPECT_LT(texel, layout.width * layout.height);
        const double v = lookup(i, 1) + double(k) * layout.rows_per_frame / layout.height;
        EXPECT_EQ(std::lround(lookup(i, 0) * layout.width - 0.5), texel % layout.width);
        EXPECT_EQ(std::lround(v * layout.height - 0.5), texel / layout.width);
      }
  }
}

// Oracle: arithmetic. 8193 vertices take two rows of 8192, so 4096 frames fit and 4097 do not.
TEST(TexelLayout, RefusesWhatDoesNotFit) {
  EXPECT_EQ(TexelLayout::make(8193, 4096).height, 8192);
  try {
    TexelLayout::make(8193, 4097);
    FAIL() << "it was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    EXPECT_NE(std::string(error.what()).find("at most 4096"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
