#include "wilt/import/photo_petiole.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "wilt/core/parallel.hpp"
#include "wilt/import/photo_ridges.hpp"
#include "wilt/import/photo_texture.hpp"

namespace wilt::detail {
namespace {

constexpr int kSide = 420;        // pixels of the reduced leaf in which veins are sought
constexpr int kDirections = 72;   // of rays around a point
constexpr double kRayFrom = 5.0;  // pixels of the reduced leaf
constexpr double kRayTo = 75.0;
constexpr int kFewestVeins = 5;
constexpr double kWideGap = 105.0 / 180.0 * std::numbers::pi;  // between neighbouring main veins
constexpr double kFaintest = 0.42;  // strength of a main vein over the second strongest
constexpr double kPi = std::numbers::pi;

// The mean over a stretch of the ray at `angle`, a cone of 14 degrees: main veins bend a little.
cv::Mat1f ray_kernel(double angle, double from, double to) {
  constexpr double kSpread = 0.12;
  const int reach = static_cast<int>(to * (1.0 + kSpread)) + 1;
  cv::Mat1f kernel(2 * reach + 1, 2 * reach + 1, 0.0f);
  const cv::Point2d along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const cv::Point2d p(x, y);
      const double r = p.dot(along);
      if (r >= from && r <= to && std::abs(p.dot(across)) <= 1.0 + kSpread * r)
        kernel(reach + y, reach + x) = static_cast<float>(1.0 / (to - from));
    }
  }
  return kernel;
}

// For every pixel how steadily lines run along a ray from it: the weaker of its near and its far half.
cv::Mat1f ray_strength(const Ridges& ridges, double angle) {
  cv::Mat1f aligned(ridges.strength.size());
  aligned.forEach([&](float& value, const int* at) {
    const double turn = std::cos(ridges.direction(at[0], at[1]) - angle);
    const double agreement = std::max(0.0, (turn * turn - 0.9) / 0.1);  // within 18 degrees
    value = static_cast<float>(agreement * ridges.strength(at[0], at[1]));
  });
  constexpr double kMiddle = 0.5 * (kRayFrom + kRayTo);
  cv::Mat1f near_half, far_half;
  cv::filter2D(aligned, near_half, CV_32F, ray_kernel(angle, kRayFrom, kMiddle), {-1, -1}, 0.0,
               cv::BORDER_CONSTANT);
  cv::filter2D(aligned, far_half, CV_32F, ray_kernel(angle, kMiddle, kRayTo), {-1, -1}, 0.0,
               cv::BORDER_CONSTANT);
  return cv::min(near_half, far_half);
}

std::vector<cv::Mat1f> ray_strengths(const Ridges& ridges) {
  std::vector<cv::Mat1f> rays(kDirections);
  parallel_for(kDirections, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      rays[static_cast<std::size_t>(k)] = ray_strength(ridges, 2.0 * kPi * k / kDirections);
  });
  return rays;
}

struct Fan {
  double score = 0.0;
  std::vector<int> directions;  // of distinct veins, the strongest first
  std::vector<double> strengths;
};

// Veins that leave a pixel: the strongest rays, at least 20 degrees apart.
Fan fan_at(const std::vector<cv::Mat1f>& rays, int y, int x) {
  constexpr int kApart = kDirections / 18;
  std::vector<std::pair<float, int>> order;
  for (int k = 0; k < kDirections; ++k) order.emplace_back(-rays[static_cast<std::size_t>(k)](y, x), k);
  std::sort(order.begin(), order.end());
  Fan fan;
  for (const auto& [negative, k] : order) {
    const bool apart = std::all_of(fan.directions.begin(), fan.directions.end(), [k = k](int other) {
      const int between = std::abs(k - other);
      return std::min(between, kDirections - between) >= kApart;
    });
    if (!apart) continue;
    fan.directions.push_back(k);
    fan.strengths.push_back(-negative);
    if (fan.directions.size() == 7) break;
  }
  // A fork is as good as its fifth vein is strong, and better for every further one.
  fan.score = fan.strengths[2] + fan.strengths[3] + 2.0 * fan.strengths[4] + 0.5 * fan.strengths[5];
  return fan;
}

// Whether veins leave to all sides but one, where the sinus is; at a node of a pinnate leaf they leave two
// sides free, left and right of its midrib.
bool is_palmate(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + 2.0 * kPi);
  int wide = 0;
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) wide += angles[k + 1] - angles[k] > kWideGap ? 1 : 0;
  return wide <= 1;
}

// Where lines along the fan's directions meet: least squares over the lines' pixels near the fork.
cv::Point2d sharpened(const Ridges& ridges, const Fan& fan, cv::Point2d place, int veins) {
  constexpr double kTo = 40.0;
  for (int round = 0; round < 4; ++round) {
    cv::Matx22d normal = cv::Matx22d::zeros();
    cv::Vec2d right(0.0, 0.0);
    for (int k = 0; k < veins; ++k) {
      const double angle = 2.0 * kPi * fan.directions[static_cast<std::size_t>(k)] / kDirections;
      for (int y = 0; y < ridges.strength.rows; ++y) {
        for (int x = 0; x < ridges.strength.cols; ++x) {
          const cv::Vec2d from(x - place.x, y - place.y);
          const double r = cv::norm(from), line = ridges.direction(y, x);
          if (r < kRayFrom || r > kTo || std::cos(std::atan2(from[1], from[0]) - angle) < 0.94) continue;
          const double turn = std::cos(line - angle);
          if (turn * turn < 0.9) continue;
          const cv::Vec2d across(-std::sin(line), std::cos(line));
          const double weight = ridges.strength(y, x) / r;
          normal += weight * cv::Matx22d(across * across.t());
          right += weight * across * (across[0] * x + across[1] * y);
        }
      }
    }
    cv::Vec2d next;
    if (!cv::solve(normal, right, next, cv::DECOMP_CHOLESKY)) break;
    const cv::Point2d move(next[0] - place.x, next[1] - place.y);
    place += std::min(1.0, 6.0 / std::max(cv::norm(move), 1e-9)) * move;
  }
  return place;
}

// What is not covered and reaches the frame.
cv::Mat1b outside_of(const cv::Mat1f& share) {
  cv::Mat1b open = share < 0.5f;
  cv::copyMakeBorder(open, open, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  cv::floodFill(open, {0, 0}, cv::Scalar(128));
  return cv::Mat1b(open == 128)(cv::Rect(1, 1, share.cols, share.rows));
}

}  // namespace

std::optional<VeinFork> find_vein_fork(const cv::Mat3b& rgb, const PhotoObject& object) {
  const double reduction = std::max(object.box.width, object.box.height) / double(kSide);
  const cv::Size size(cvRound(object.box.width / reduction), cvRound(object.box.height / reduction));
  if (reduction < 0.5 || std::min(size.width, size.height) < 8) return std::nullopt;
  // With its colours carried on beyond it the leaf's margin is no line.
  cv::Mat3f lab;
  bled_colours(rgb, object).convertTo(lab, CV_32F, 1.0 / 255.0);
  cv::resize(lab, lab, size, 0, 0, cv::INTER_AREA);
  cv::cvtColor(lab, lab, cv::COLOR_RGB2Lab);
  cv::Mat1f share;
  cv::resize(object.share, share, size, 0, 0, cv::INTER_AREA);
  const cv::Mat1b inside = share > 0.5f;
  const Ridges ridges = find_ridges(lab, inside);
  const std::vector<cv::Mat1f> rays = ray_strengths(ridges);
  cv::Mat1b near_it;
  cv::dilate(inside, near_it, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  Fan best;
  cv::Point best_at;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (!near_it(y, x)) continue;
      const Fan fan = fan_at(rays, y, x);
      if (fan.score <= best.score) continue;
      best = fan;
      best_at = {x, y};
    }
  }
  const auto veins = std::count_if(best.strengths.begin(), best.strengths.end(), [&](double strength) {
    return strength >= kFaintest * best.strengths[1];
  });
  if (veins < kFewestVeins) return std::nullopt;
  VeinFork fork;
  const cv::Point2d place = sharpened(ridges, best, best_at, static_cast<int>(veins));
  fork.place = {object.box.x + (place.x + 0.5) * reduction, object.box.y + (place.y + 0.5) * reduction};
  for (int k = 0; k < veins; ++k)
    fork.angles.push_back(2.0 * kPi * best.directions[static_cast<std::size_t>(k)] / kDirections);
  if (!is_palmate(fork.angles)) return std::nullopt;
  return fork;
}

double open_sinus(PhotoObject& object, const cv::Point2d& petiole, const cv::Point2d& towards) {
  constexpr double kStep = 0.5, kHalfOpening = 0.02;  // pixels; half the wedge's angle, radians
  constexpr double kDetour = 0.15;                    // of the size: what turning by a right angle is worth
  const double size = std::max(object.box.width, object.box.height);
  const double wanted = std::atan2(towards.y - petiole.y, towards.x - petiole.x);
  const cv::Mat1b outside = outside_of(object.share);
  const cv::Point2d start(petiole.x - object.box.x - 0.5, petiole.y - object.box.y - 0.5);
  const auto state = [&](const cv::Point2d& p) {  // 0 outside, 1 in a hole, 2 in tissue
    const int x = cvRound(p.x), y = cvRound(p.y);
    if (x < 0 || y < 0 || x >= outside.cols || y >= outside.rows || outside(y, x)) return 0;
    return object.share(y, x) < 0.5f ? 1 : 2;
  };
  double least = std::numeric_limits<double>::infinity(), best_reach = 0.0, best_tissue = 0.0;
  cv::Point2d best;
  for (double turn = 0.0; turn < 2.0 * kPi; turn += kPi / 360.0) {
    const double angle = wanted + turn;
    const cv::Point2d along(std::cos(angle), std::sin(angle));
    double reach = 0.0, tissue = 0.0;
    for (int here = state(start); here != 0; here = state(start + reach * along)) {
      tissue += here == 2 ? kStep : 0.0;
      reach += kStep;
    }
    const double cost = tissue / size + kDetour * (1.0 - std::cos(turn));
    if (cost >= least) continue;
    least = cost;
    best_tissue = tissue;
    best = along;
    best_reach = reach;
  }
  if (best_tissue <= 0.015 * size) return 0.0;
  const cv::Point2d across(-best.y, best.x), end = start + (best_reach + 2.0) * best;
  const double half = 1.0 + kHalfOpening * best_reach;
  std::vector<cv::Point> wedge;
  constexpr int kShift = 6;  // of the fixed-point coordinates
  for (const cv::Point2d& p :
       {start - 0.75 * across, end - half * across, end + half * across, start + 0.75 * across})
    wedge.emplace_back(p * double(1 << kShift));
  cv::Mat1b cut(object.share.size(), 0);
  cv::fillConvexPoly(cut, wedge, cv::Scalar(255), cv::LINE_AA, kShift);
  object.share.forEach(
      [&](float& share, const int* at) { share = std::min(share, 1.0f - cut(at[0], at[1]) / 255.0f); });
  return best_tissue;
}

}  // namespace wilt::detail
