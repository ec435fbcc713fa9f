#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/venation/margin.hpp"

namespace wilt {
namespace {

constexpr double kPi = std::numbers::pi;

/// d(s) sampled at `count` even places of a margin of length 1.
MarginProfile sampled(int count, const std::function<double(double)>& d) {
  MarginProfile profile;
  profile.perimeter = 1.0;
  profile.s.resize(count);
  profile.d.resize(count);
  for (int i = 0; i < count; ++i) {
    profile.vertices.push_back(VertexId(i));
    profile.s(i) = static_cast<double>(i) / count;
    profile.d(i) = d(profile.s(i));
  }
  return profile;
}

/// Zero at the petiole, `lobes` equal peaks at s = (2 k + 1) / (2 lobes).
MarginProfile lobed(int count, int lobes) {
  return sampled(count,
                 [&](double s) { return std::sin(kPi * s) + 0.3 * (1.0 - std::cos(2.0 * kPi * lobes * s)); });
}

std::vector<int> indices(const std::vector<Peak>& peaks) {
  std::vector<int> result;
  for (const Peak& peak : peaks) result.push_back(peak.index);
  return result;
}

// Oracle: analytic. The sine under the lobes moves their tops by a fraction of their width.
TEST(FindPeaks, FindEveryLobeOnce) {
  for (const int lobes : {1, 3, 5, 7, 9}) {
    for (const int count : {60, 400, 3001}) {
      const std::vector<Peak> peaks = find_peaks(lobed(count, lobes));
      ASSERT_EQ(static_cast<int>(peaks.size()), lobes) << count;
      for (int k = 0; k < lobes; ++k)
        EXPECT_NEAR(peaks[k].index / double(count), (2 * k + 1) / (2.0 * lobes), 0.35 / lobes) << count;
    }
  }
}

// Oracle: analytic. Two unequal lobes over a saddle: the higher one's prominence is its height over the
// lowest point, the lower one's its height over the saddle.
TEST(FindPeaks, MeasureProminenceOnTheCircle) {
  const auto tent = [](double s, double at, double height) { return height - 20.0 * std::abs(s - at); };
  const MarginProfile profile = sampled(1000, [&](double s) {
    return std::max({0.5, tent(s, 0.3, 3.0), tent(s, 0.6, 2.0), tent(s, 0.45, 1.6)});
  });
  const std::vector<Peak> peaks = find_peaks(profile);
  ASSERT_EQ(indices(peaks), (std::vector<int>{300, 450, 600}));
  EXPECT_NEAR(peaks[0].prominence, 2.5, 1e-12);
  EXPECT_NEAR(peaks[1].prominence, 0.8, 1e-12);  // its tent meets the left one at 0.8, then the floor
  EXPECT_NEAR(peaks[2].prominence, 1.5, 1e-12);
}

double brute_prominence(const MarginProfile& profile, int peak) {
  // The highest level at which the peak is still cut off from anything higher, by flooding from the top down.
  const int count = static_cast<int>(profile.d.size());
  std::set<double, std::greater<>> levels(profile.d.begin(), profile.d.end());
  for (const double level : levels) {
    if (level > profile.d(peak)) continue;
    std::set<int> island{peak};
    for (const int step : {1, count - 1}) {
      for (int i = (peak + step) % count; profile.d(i) >= level && island.insert(i).second;)
        i = (i + step) % count;
    }
    const bool joined =
        std::any_of(island.begin(), island.end(), [&](int i) { return profile.d(i) > profile.d(peak); });
    if (joined || static_cast<int>(island.size()) == count) return profile.d(peak) - level;
  }
  return profile.d(peak) - *levels.rbegin();
}

std::vector<int> brute_peaks(const MarginProfile& profile, const PeakOptions& options) {
  const int count = static_cast<int>(profile.d.size());
  std::vector<int> result;
  for (int i = 1; i < count; ++i) {
    bool highest = true;
    for (int j = 0; j < count; ++j) {
      const double gap = std::abs(profile.s(i) - profile.s(j));
      const int steps = std::min((i - j + count) % count, (j - i + count) % count);
      if (steps > 1 &&
          std::min(gap, profile.perimeter - gap) > 0.5 * options.window_length * profile.perimeter)
        continue;
      if (profile.d(j) > profile.d(i) || (profile.d(j) == profile.d(i) && j < i)) highest = false;
    }
    if (highest && brute_prominence(profile, i) >= options.min_prominence * profile.d.maxCoeff())
      result.push_back(i);
  }
  return result;
}

// Oracle: differential against the definitions, on random walks with uneven steps and many equal heights.
TEST(FindPeaks, AgreeWithTheDefinition) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed, "margin");
    const int count = 20 + random.index(60);
    MarginProfile profile;
    profile.s.resize(count);
    profile.d.resize(count);
    double height = 20.0;
    for (int i = 0; i < count; ++i) {
      profile.vertices.push_back(VertexId(i));
      profile.s(i) = profile.perimeter;
      profile.perimeter += random.uniform(0.01, 1.0);
      profile.d(i) = height;
      height = std::max(0.0, height + random.index(7) - 3);
    }
    for (const double window : {0.0, 0.06, 0.2, 0.5}) {
      const PeakOptions options{PeakRule::prominence, 8, window, 0.05};
      const std::vector<Peak> peaks = find_peaks(profile, options);
      EXPECT_EQ(indices(peaks), brute_peaks(profile, options)) << "seed " << seed << ", window " << window;
      for (const Peak& peak : peaks)
        EXPECT_EQ(peak.prominence, brute_prominence(profile, peak.index)) << "seed " << seed;
    }
  }
}

TEST(FindPeaks, CountAPlateauOnce) {
  for (const double window : {0.0, 0.06}) {
    for (const int width : {2, 3, 40}) {  // 40 of 200 is longer than the window
      const MarginProfile profile = sampled(200, [&](double s) {
        const double outside = std::max(0.0, std::abs(s * 200 - 100) - width / 2.0);
        return 10.0 - 0.05 * outside;
      });
      EXPECT_EQ(find_peaks(profile, {PeakRule::prominence, 8, window, 0.02}).size(), 1u)
          << window << " " << width;
    }
  }
  EXPECT_TRUE(find_peaks(sampled(100, [](double) { return 1.0; })).empty());
}

// Oracle: invariance. Powers of two change exponents only.
TEST(FindPeaks, DoNotDependOnTheUnit) {
  MarginProfile profile = lobed(500, 7);
  const std::vector<Peak> peaks = find_peaks(profile);
  profile.s *= 0x1p-30;
  profile.d *= 0x1p-30;
  profile.perimeter *= 0x1p-30;
  const std::vector<Peak> tiny = find_peaks(profile);
  EXPECT_EQ(indices(tiny), indices(peaks));
  for (std::size_t i = 0; i < peaks.size(); ++i) EXPECT_EQ(tiny[i].prominence, 0x1p-30 * peaks[i].prominence);
}

// Oracle: invariance. The signal is a circle: where it is cut open changes the indices alone.
TEST(FindPeaks, DoNotDependOnWhereTheCircleIsCut) {
  const int count = 500;
  const MarginProfile profile = lobed(count, 5);
  const std::vector<int> peaks = indices(find_peaks(profile));
  for (const int shift : {1, 17, 260, 499}) {
    const MarginProfile turned = sampled(count, [&](double s) {
      return profile.d((static_cast<int>(std::lround(s * count)) + shift) % count);
    });
    std::vector<int> back;
    for (const int i : indices(find_peaks(turned))) back.push_back((i + shift) % count);
    std::sort(back.begin(), back.end());
    EXPECT_EQ(back, peaks) << shift;
  }
}

// Oracle: invariance. A quarter of the least prominence is below what counts; a peak may move by the noise
// over its curvature, a few hundredths of the margin.
TEST(FindPeaks, EndureNoise) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    MarginProfile profile = lobed(600, 5);
    const std::vector<int> peaks = indices(find_peaks(profile));
    Random random(seed, "noise");
    for (double& d : profile.d) d += random.uniform(-0.005, 0.005) * 1.6;
    const std::vector<int> noisy = indices(find_peaks(profile));
    ASSERT_EQ(noisy.size(), peaks.size()) << "seed " << seed;
    for (std::size_t i = 0; i < peaks.size(); ++i)
      EXPECT_NEAR(noisy[i], peaks[i], 0.02 * 600) << "seed " << seed;
  }
}

// Oracle: the rule itself. Rising over exactly six vertices, a window of six finds it, one of seven does not.
TEST(FindPeaks, TakeTheWindowLiterally) {
  const MarginProfile profile =
      sampled(100, [](double s) { return 50.0 - std::min(6.0, std::abs(std::round(100 * s) - 40.0)); });
  PeakOptions options{PeakRule::window, 6, 0.06, 0.02};
  EXPECT_EQ(indices(find_peaks(profile, options)), std::vector<int>{40});
  options.window_vertices = 7;
  EXPECT_TRUE(find_peaks(profile, options).empty());
  options.window_vertices = 60;  // longer than the margin
  EXPECT_TRUE(find_peaks(profile, options).empty());
}

TEST(FindPeaks, RefuseOptionsOutOfRange) {
  const MarginProfile profile = lobed(100, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PeakOptions& options :
       {PeakOptions{PeakRule::window, 0, 0.06, 0.02}, PeakOptions{PeakRule::prominence, 8, 0.51, 0.02},
        PeakOptions{PeakRule::prominence, 8, -0.1, 0.02}, PeakOptions{PeakRule::prominence, 8, 0.06, 1.1},
        PeakOptions{PeakRule::prominence, 8, nan, 0.02}, PeakOptions{PeakRule::prominence, 8, 0.06, nan}})
    EXPECT_THROW(find_peaks(profile, options), Error);
}

// Oracle: analytic, a unit square walked from its lower left corner.
TEST(ExpandMargin, StartsAtThePetioleAndKeepsTheOrder) {
  Points2 flat(5, 2);
  flat << 0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5;
  const std::vector<VertexId> margin{VertexId(2), VertexId(1), VertexId(0), VertexId(3)};
  const MarginProfile profile = expand_margin(margin, flat, VertexId(0));
  EXPECT_EQ(profile.vertices, (std::vector<VertexId>{VertexId(0), VertexId(3), VertexId(2), VertexId(1)}));
  EXPECT_EQ(profile.perimeter, 4.0);
  EXPECT_EQ(profile.s, Eigen::Vector4d(0, 1, 2, 3));
  EXPECT_EQ(profile.d, Eigen::Vector4d(0, 1, std::sqrt(2.0), 1));
}

TEST(ExpandMargin, StartsNextToAPetioleInside) {
  Points2 flat(5, 2);
  flat << 0, 0, 1, 0, 1, 1, 0, 1, 0.9, 0.4;
  const std::vector<VertexId> margin{VertexId(0), VertexId(3), VertexId(2), VertexId(1)};
  const MarginProfile profile = expand_margin(margin, flat, VertexId(4));
  EXPECT_EQ(profile.vertices.front(), VertexId(1));
  EXPECT_NEAR(profile.d(0), std::hypot(0.1, 0.4), 1e-15);
}

}  // namespace
}  // namespace wilt
