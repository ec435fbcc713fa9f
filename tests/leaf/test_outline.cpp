#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "leaf/peaks.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

std::vector<Vec2> ring_of(const Points2& points) {
  std::vector<Vec2> ring;
  for (Eigen::Index i = 0; i < points.rows(); ++i) ring.push_back(points.row(i).transpose());
  return ring;
}

Points2 polygon(std::initializer_list<Vec2> corners) {
  Points2 points(static_cast<Eigen::Index>(corners.size()), 2);
  Eigen::Index i = 0;
  for (const Vec2& corner : corners) points.row(i++) = corner.transpose();
  return points;
}

Points2 circle(double radius, int count, Vec2 centre = Vec2::Zero()) {
  Points2 points(count, 2);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.row(i) << centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle);
  }
  return points;
}

std::string complaint(const Outline& outline) {
  try {
    validate_outline(outline);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "";
}

void expect_complaint(const Outline& outline, const std::string& part) {
  const std::string message = complaint(outline);
  EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: '" << message << "'";
}

// Property over seeds. Oracle: the botany (maple 7 lobes, ivy and grape 5, the others 1) through an
// independent peak finder; 0.02 is where later stages cut, the gap on both sides is what makes them safe on
// coarse meshes.
TEST(BladeOutline, HasTheTipsOfItsSpeciesForEverySeed) {
  for (const std::string& name : species_names()) {
    const auto tips = static_cast<std::size_t>(test::expected_tips(name));
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const BladeOutline blade = blade_outline(name, seed);
      EXPECT_EQ(blade.tips.size(), tips) << name << " seed " << seed;
      const std::vector<double> prominences = test::prominences(ring_of(blade.outline.margin), blade.petiole);
      ASSERT_GE(prominences.size(), tips) << name << " seed " << seed;
      EXPECT_GE(prominences[tips - 1], 0.04) << name << " seed " << seed;
      if (prominences.size() > tips) {
        EXPECT_LE(prominences[tips], 0.015) << name << " seed " << seed;
      }
    }
  }
}

TEST(BladeOutline, NeverCrossesItself) {
  for (const std::string& name : species_names()) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      EXPECT_EQ(complaint(blade_outline(name, seed).outline), "") << name << " seed " << seed;
    }
  }
}

TEST(BladeOutline, PutsThePetioleAtTheOriginAndTheApexOnTheAxis) {
  for (const std::string& name : species_names()) {
    const BladeOutline blade = blade_outline(name, 3);
    EXPECT_EQ(blade.outline.margin.row(0).norm(), 0.0) << name;
    const Vec2 apex = blade.tips[blade.tips.size() / 2];
    EXPECT_NEAR(apex.x(), 0.0, 1e-12) << name;
    EXPECT_NEAR(apex.y(), 1.0, 0.1) << name;  // a unit is about the leaf's length
    // Clockwise from the petiole: the left side comes first.
    if (blade.tips.size() > 1) {
      EXPECT_LT(blade.tips.front().x(), 0.0) << name;
    }
  }
}

// Oracle: descriptions in floras. White willow is six to eight times as long as wide and widest below the
// middle; lime and Norway maple are cordate (the margin falls behind the petiole), black poplar's base is
// nearly straight.
TEST(BladeOutline, HasTheProportionsOfItsSpecies) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Points2 willow = blade_outline("willow", seed).outline.margin;
    std::vector<double> left(50, 0.0), right(50, 0.0);
    for (Eigen::Index i = 0; i < willow.rows(); ++i) {
      const auto bin = static_cast<std::size_t>(std::clamp(willow(i, 1), 0.0, 0.999) * 50);
      left[bin] = std::min(left[bin], willow(i, 0));
      right[bin] = std::max(right[bin], willow(i, 0));
    }
    double width = 0.0, widest = 0.0;
    for (std::size_t k = 0; k < 50; ++k) {
      if (right[k] - left[k] > width) {
        width = right[k] - left[k];
        widest = (static_cast<double>(k) + 0.5) / 50.0;
      }
    }
    EXPECT_GE(1.0 / width, 6.0) << seed;
    EXPECT_LE(1.0 / width, 8.0) << seed;
    EXPECT_LT(widest, 0.48) << seed;
    EXPECT_LT(blade_outline("tilia", seed).outline.margin.col(1).minCoeff(), -0.07) << seed;
    EXPECT_LT(blade_outline("maple", seed).outline.margin.col(1).minCoeff(), -0.12) << seed;
    EXPECT_LT(blade_outline("grape", seed).outline.margin.col(1).minCoeff(), -0.30) << seed;
    EXPECT_GT(blade_outline("poplar", seed).outline.margin.col(1).minCoeff(), -0.05) << seed;
  }
}

TEST(BladeOutline, SeedsAreIndividualsAndRepeatable) {
  for (const std::string& name : species_names()) {
    const Points2 one = blade_outline(name, 1).outline.margin;
    EXPECT_EQ(one, blade_outline(name, 1).outline.margin) << name;
    const Points2 two = blade_outline(name, 2).outline.margin;
    const Eigen::Index n = std::min(one.rows(), two.rows());
    // More than a hundredth of the leaf's length somewhere: the difference can be seen.
    EXPECT_GT((one.topRows(n) - two.topRows(n)).rowwise().norm().maxCoeff(), 0.01) << name;
  }
}

TEST(ValidateOutline, AcceptsRingsOfEitherOrientation) {
  Outline outline{circle(1.0, 50), {circle(0.3, 20), circle(0.1, 12, Vec2(0.6, 0.0))}};
  EXPECT_EQ(complaint(outline), "");
  outline.margin = outline.margin.colwise().reverse().eval();
  EXPECT_EQ(complaint(outline), "");
}

TEST(ValidateOutline, RefusesWhatIsNoRing) {
  expect_complaint({polygon({{0, 0}, {1, 0}}), {}}, "has 2 points");
  expect_complaint({polygon({{0, 0}, {1, 0}, {2, 0}}), {}}, "no area");
  expect_complaint({polygon({{0, 0}, {1, 0}, {std::nan(""), 1}}), {}}, "point 2 of the margin");
  expect_complaint({polygon({{0, 0}, {1, 0}, {std::numeric_limits<double>::infinity(), 1}}), {}}, "finite");
  expect_complaint({circle(1.0, 20), {polygon({{0, 0}, {0.1, 0}})}}, "hole 1");
}

TEST(ValidateOutline, NamesTheSegmentsThatMeet) {
  // An hourglass (lopsided, so that its area is not zero): segment 1-2 crosses 3-0.
  expect_complaint({polygon({{0, 0}, {1, 0}, {0, 1}, {0.6, 1}}), {}}, "point 1 to 2 of the margin");
  expect_complaint({polygon({{0, 0}, {1, 0}, {0, 1}, {0.6, 1}}), {}}, "point 3 to 0 of the margin");
  // A spike that runs back over itself, a corner that touches a side, a pinch at one point.
  expect_complaint({polygon({{0, 0}, {2, 0}, {2, 2}, {2, 1}, {0, 1}}), {}}, "must not cross or touch");
  expect_complaint({polygon({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}), {}}, "must not cross or touch");
  expect_complaint({polygon({{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}), {}},
                   "must not cross or touch");
}

TEST(ValidateOutline, RefusesMisplacedHoles) {
  expect_complaint({circle(1.0, 40), {circle(0.2, 12, Vec2(3, 0))}}, "hole 1 of the outline lies outside");
  expect_complaint({circle(1.0, 40), {circle(0.4, 12, Vec2(0.8, 0))}}, "of hole 1");
  expect_complaint({circle(1.0, 40), {circle(0.5, 12), circle(0.2, 12)}},
                   "hole 2 of the outline lies inside hole 1");
}

// Oracle: brute force over all pairs on random polygons, some of which cross themselves.
TEST(ValidateOutline, AgreesWithTestingAllPairs) {
  const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  int crossed = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed, "polygon");
    const int n = 5 + random.index(40);
    Points2 ring(n, 2);
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 1.5 * random.uniform()) / n;
      const double radius = random.uniform(0.5, 1.5);
      ring.row(i) << radius * std::cos(angle), radius * std::sin(angle);
    }
    const std::vector<Vec2> p = ring_of(ring);
    bool any = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
      for (std::size_t j = i + 2; j < p.size(); ++j) {
        if (i == 0 && j + 1 == p.size()) continue;
        const Vec2 &a = p[i], &b = p[i + 1], &c = p[j], &d = p[(j + 1) % p.size()];
        any |= turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
      }
    }
    EXPECT_EQ(complaint({ring, {}}) != "", any) << "seed " << seed;
    crossed += any;
  }
  EXPECT_GT(crossed, 20);  // both answers occur
  EXPECT_LT(crossed, 180);
}

}  // namespace
}  // namespace wilt
