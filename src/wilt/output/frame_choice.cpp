#include "wilt/output/frame_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/types.hpp"

namespace wilt {
namespace {

constexpr int kMostFrames = 2000;
constexpr int kBlock = 4096;  // points whose inner products are summed at a time

// The share of the later of two kept frames in what is shown at a frame between them.
double share(const std::vector<Frame>& frames, int before, int frame, int after) {
  const double first = frames[static_cast<std::size_t>(before)].iteration;
  const double last = frames[static_cast<std::size_t>(after)].iteration;
  return (frames[static_cast<std::size_t>(frame)].iteration - first) / (last - first);
}

/// Inner products of the frames' displacements, #F x #F, of the blade and the stalk.
Eigen::MatrixXd inner_products(const std::vector<Frame>& frames) {
  const auto count = static_cast<Eigen::Index>(frames.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  for (Points3 Frame::*part : {&Frame::positions, &Frame::stalk}) {
    const Points3& rest = frames.front().*part;
    for (Eigen::Index begin = 0; begin < rest.rows(); begin += kBlock) {
      const Eigen::Index size = std::min<Eigen::Index>(kBlock, rest.rows() - begin);
      Eigen::MatrixXd displacements(3 * size, count);
      for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::Map<Points3>(displacements.col(k).data(), size, 3) =
            (frames[static_cast<std::size_t>(k)].*part).middleRows(begin, size) -
            rest.middleRows(begin, size);
      }
      products.noalias() += displacements.transpose() * displacements;
    }
  }
  return products;
}

/// cost(i, j): the squared deviations of the frames between i and j when those two are neighbours.
Eigen::MatrixXd costs_of_neighbours(const std::vector<Frame>& frames) {
  const int count = static_cast<int>(frames.size());
  const Eigen::MatrixXd products = inner_products(frames);
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(count, count);
  parallel_for(count, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      for (int j = i + 2; j < count; ++j)
        for (int k = i + 1; k < j; ++k) {
          const double b = share(frames, i, k, j), a = 1.0 - b;
          const double squared = products(k, k) + a * a * products(i, i) + b * b * products(j, j) -
                                 2.0 * (a * products(i, k) + b * products(j, k) - a * b * products(i, j));
          cost(i, j) += std::max(squared, 0.0);
        }
  });
  return cost;
}

/// The cheapest way from the first frame to the last over `most` frames.
std::vector<int> cheapest(const Eigen::MatrixXd& cost, int most) {
  const auto count = static_cast<int>(cost.rows());
  Eigen::VectorXd sum = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  sum[0] = 0.0;
  Eigen::MatrixXi before(count, most);
  for (int step = 1; step < most; ++step) {
    Eigen::VectorXd next = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
    for (int j = step; j < count; ++j) next[j] = (sum + cost.col(j)).head(j).minCoeff(&before(j, step));
    sum = next;
  }
  std::vector<int> kept{count - 1};
  for (int step = most - 1; step > 0; --step) kept.push_back(before(kept.back(), step));
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// Measures what the choice misses, frame by frame.
void measure(const std::vector<Frame>& frames, FrameChoice& choice) {
  double sum = 0.0;
  for (std::size_t next = 1; next < choice.kept.size(); ++next) {
    const int before = choice.kept[next - 1], after = choice.kept[next];
    for (int k = before + 1; k < after; ++k) {
      const double b = share(frames, before, k, after);
      for (Points3 Frame::*part : {&Frame::positions, &Frame::stalk}) {
        const auto at = [&](int frame) -> const Points3& {
          return frames[static_cast<std::size_t>(frame)].*part;
        };
        if (at(k).rows() == 0) continue;
        const Eigen::VectorXd squared =
            (at(k) - (1.0 - b) * at(before) - b * at(after)).rowwise().squaredNorm();
        sum += squared.sum();
        choice.largest = std::max(choice.largest, std::sqrt(squared.maxCoeff()));
      }
    }
  }
  const Eigen::Index points = frames.front().positions.rows() + frames.front().stalk.rows();
  choice.rms = std::sqrt(sum / (static_cast<double>(points) * static_cast<double>(frames.size())));
}

}  // namespace

FrameChoice choose_frames(const std::vector<Frame>& frames, int most) {
  if (most < 2) {
    throw Error(ErrorCode::configuration,
                fmt::format("{} frames are asked for; a clip has 2 or more, the first and the last", most));
  }
  const int count = static_cast<int>(frames.size());
  FrameChoice choice;
  if (count <= most) {
    choice.kept.resize(frames.size());
    std::iota(choice.kept.begin(), choice.kept.end(), 0);
    return choice;
  }
  if (count > kMostFrames) {
    throw Error(
        ErrorCode::configuration,
        fmt::format("{} of {} frames cannot be chosen: give at most {} frames", most, count, kMostFrames));
  }
  choice.kept = cheapest(costs_of_neighbours(frames), most);
  measure(frames, choice);
  return choice;
}

}  // namespace wilt
