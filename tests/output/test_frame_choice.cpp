#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "output/sample_leaf.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/output/frame_choice.hpp"

namespace wilt {
namespace {

// One point that moves along x at the iterations given.
std::vector<Frame> moving_point(const std::vector<int>& iterations, const std::function<double(int)>& x) {
  std::vector<Frame> frames;
  for (const int iteration : iterations) {
    Frame frame;
    frame.iteration = iteration;
    frame.positions = Points3::Zero(1, 3);
    frame.positions(0, 0) = x(iteration);
    frames.push_back(frame);
  }
  return frames;
}

// Oracle: analytic. A path with one kink is played without error by its two ends and the kink.
TEST(FrameChoice, FindsTheKink) {
  const auto frames =
      moving_point({0, 5, 10, 30, 40, 80, 100}, [](int i) { return i < 30 ? 2.0 * i : 60.0; });
  const FrameChoice choice = choose_frames(frames, 3);
  EXPECT_EQ(choice.kept, (std::vector<int>{0, 3, 6}));
  EXPECT_LT(choice.largest, 1e-12);
}

// Oracle: analytic. x = t^2 without its middle frame misses (1/2)^2 of the parabola at one of three frames.
TEST(FrameChoice, SaysWhatItMisses) {
  const auto frames = moving_point({0, 50, 100}, [](int i) { return 1e-4 * i * i; });
  const FrameChoice choice = choose_frames(frames, 2);
  EXPECT_NEAR(choice.largest, 0.25, 1e-12);
  EXPECT_NEAR(choice.rms, 0.25 / std::sqrt(3.0), 1e-12);
}

// Oracle: brute force over all choices, on random walks; the seed is fixed.
TEST(FrameChoice, IsTheBestOfAll) {
  const std::uint64_t seed = 11;
  Random random(seed, "walk");
  for (int round = 0; round < 20; ++round) {
    double x = 0.0;
    const auto frames =
        moving_point({0, 3, 4, 9, 11, 12, 20, 23, 30}, [&](int) { return x += random.uniform() - 0.5; });
    const auto missed = [&](const std::vector<int>& kept) {
      double sum = 0.0;
      for (std::size_t n = 1; n < kept.size(); ++n)
        for (int k = kept[n - 1] + 1; k < kept[n]; ++k) {
          const Frame &a = frames[std::size_t(kept[n - 1])], &b = frames[std::size_t(kept[n])],
                      &f = frames[std::size_t(k)];
          const double t = double(f.iteration - a.iteration) / (b.iteration - a.iteration);
          sum += std::pow(f.positions(0, 0) - (1.0 - t) * a.positions(0, 0) - t * b.positions(0, 0), 2);
        }
      return sum;
    };
    double best = std::numeric_limits<double>::infinity();
    for (int i = 1; i < 8; ++i)
      for (int j = i + 1; j < 8; ++j) best = std::min(best, missed({0, i, j, 8}));
    EXPECT_NEAR(missed(choose_frames(frames, 4).kept), best, 1e-12) << "seed " << seed << " round " << round;
  }
}

// Oracle: a clip that is short enough stays as it is; one frame cannot be a clip.
TEST(FrameChoice, KeepsAllWhereItMay) {
  const test::Sample sample;
  const FrameChoice choice = choose_frames(sample.frames, 5);
  EXPECT_EQ(choice.kept, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(choice.largest, 0.0);
  EXPECT_THROW(choose_frames(sample.frames, 1), Error);
}

}  // namespace
}  // namespace wilt
