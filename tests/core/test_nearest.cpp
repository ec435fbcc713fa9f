#include <gtest/gtest.h>

#include "wilt/core/nearest.hpp"

namespace wilt {
namespace {

const std::vector<std::string> kSpecies = {"maple", "poplar", "tilia", "ivy", "willow", "grape"};

TEST(NearestMatch, FindsTheWordOneSlipAway) {
  EXPECT_EQ(nearest_match("mapel", kSpecies), "maple");     // transposition
  EXPECT_EQ(nearest_match("gape", kSpecies), "grape");      // deletion
  EXPECT_EQ(nearest_match("willlow", kSpecies), "willow");  // insertion
  EXPECT_EQ(nearest_match("tilla", kSpecies), "tilia");     // substitution
}

TEST(NearestMatch, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest_match("chrysanthemum", kSpecies), "");
  EXPECT_EQ(did_you_mean("chrysanthemum", kSpecies), "");
  EXPECT_EQ(did_you_mean("mapel", kSpecies), " (did you mean 'maple'?)");
}

}  // namespace
}  // namespace wilt
