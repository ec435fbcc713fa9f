#include "wilt/import/photo_ridges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace wilt::detail {
namespace {

constexpr double kVeinWidth = 1.6;  // standard deviation of the smoothing, pixels
constexpr double kPi = std::numbers::pi;

// Strengths from 0 to 1, which the strongest tenth of the pixels share: the edge of a shadow is not worth
// more than a vein.
void level(cv::Mat1f& strength, const cv::Mat1b& inside) {
  std::vector<float> values;
  for (int y = 0; y < strength.rows; ++y)
    for (int x = 0; x < strength.cols; ++x)
      if (inside(y, x)) values.push_back(strength(y, x));
  if (values.empty()) return;
  const auto tenth = values.begin() + static_cast<std::ptrdiff_t>(0.9 * double(values.size()));
  std::nth_element(values.begin(), tenth, values.end());
  strength = cv::min(strength / std::max(*tenth, 1e-6f), 1.0);
}

// The larger eigenvalue of the Hessian of lightness and its direction.
Ridges find_ridges(const cv::Mat1f& channel, const cv::Mat1b& inside) {
  cv::Mat1f smooth, xx, xy, yy;
  cv::GaussianBlur(channel, smooth, {}, kVeinWidth);
  cv::Sobel(smooth, xx, CV_32F, 2, 0, 3, 0.25);
  cv::Sobel(smooth, xy, CV_32F, 1, 1, 3, 0.25);
  cv::Sobel(smooth, yy, CV_32F, 0, 2, 3, 0.25);
  Ridges ridges{cv::Mat1f(channel.size(), 0.0f), cv::Mat1f(channel.size(), 0.0f)};
  for (int y = 0; y < channel.rows; ++y) {
    for (int x = 0; x < channel.cols; ++x) {
      if (!inside(y, x)) continue;
      const double a = xx(y, x), b = xy(y, x), c = yy(y, x);
      const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
      const double across = 0.5 * std::atan2(2.0 * b, a - c);  // of the eigenvalue mean + spread
      const double first = mean + spread, second = mean - spread;
      const bool dark = std::abs(first) > std::abs(second);  // a dark line: lightness rises to both sides
      const double large = dark ? first : -second, small = dark ? second : first;
      const double along = (dark ? across : across + 0.5 * kPi) + 0.5 * kPi;
      ridges.strength(y, x) = static_cast<float>(std::max(0.0, large - std::abs(small)));
      ridges.direction(y, x) = static_cast<float>(along - kPi * std::floor(along / kPi));
    }
  }
  level(ridges.strength, inside);
  return ridges;
}

}  // namespace

Ridges find_ridges(const cv::Mat3f& lab, const cv::Mat1b& inside) {
  Ridges best;
  for (int c = 0; c < 3; ++c) {
    cv::Mat1f channel;
    cv::extractChannel(lab, channel, c);
    const Ridges ridges = find_ridges(channel, inside);
    if (c == 0) {
      best = ridges;
      continue;
    }
    const cv::Mat1b clearer = ridges.strength > best.strength;
    ridges.strength.copyTo(best.strength, clearer);
    ridges.direction.copyTo(best.direction, clearer);
  }
  return best;
}

}  // namespace wilt::detail
