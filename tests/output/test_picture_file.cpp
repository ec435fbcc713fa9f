#include "wilt/output/picture_file.hpp"

#include <gtest/gtest.h>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

// Oracle: the formats' first bytes; another name's end is refused, and so is a folder that is not there.
TEST(PictureFile, TheNameDecidesTheFormat) {
  const Image picture{8, 5, std::vector<std::uint8_t>(3 * 8 * 5, 90)};
  const std::string folder = testing::TempDir();
  write_image(folder + "/wilt_codec.png", picture);
  write_image(folder + "/wilt_codec.jpg", picture);
  EXPECT_EQ(read_file(folder + "/wilt_codec.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_file(folder + "/wilt_codec.jpg").substr(0, 2), "\xff\xd8");
  EXPECT_THROW(write_image(folder + "/wilt_codec.tiff", picture), Error);
  EXPECT_THROW(write_image(folder + "/missing/a.png", picture), Error);
}

}  // namespace
}  // namespace wilt
