#include <gtest/gtest.h>

#include "wilt/core/check.hpp"
#include "wilt/core/random.hpp"

namespace wilt {
namespace {

// Oracle: the moments of the distributions; the bands are four standard errors of 1e5 draws.
TEST(Random, HasTheMomentsOfItsDistributions) {
  Random random(42, "moments");
  const int n = 100000;
  double sum = 0.0, normal_sum = 0.0, normal_squares = 0.0;
  for (int i = 0; i < n; ++i) {
    sum += random.uniform();
    const double x = random.normal();
    normal_sum += x;
    normal_squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0.5, 4 * 0.2887 / std::sqrt(n));
  EXPECT_NEAR(normal_sum / n, 0.0, 4 / std::sqrt(n));
  EXPECT_NEAR(normal_squares / n, 1.0, 4 * 1.4142 / std::sqrt(n));
}

TEST(Random, IsFixedBySeedAndPurpose) {
  Random a(1, "outline"), b(1, "outline"), other_seed(2, "outline"), other_purpose(1, "relief");
  const double first = a.uniform();
  EXPECT_EQ(first, b.uniform());
  EXPECT_NE(first, other_seed.uniform());
  EXPECT_NE(first, other_purpose.uniform());
}

TEST(Check, PrintsItsOperands) {
  const int a = 3, b = 2;
  try {
    WILT_CHECK(a < b, a, b);
    FAIL() << "the check let 3 < 2 pass";
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("a < b (operands: 3, 2)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
