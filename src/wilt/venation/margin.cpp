// The boundary expansion of the paper (section 3) and its peaks.
//
//   v'_i  the flattened vertex i; v'_o the petiole
//   s_i   length of the margin from the petiole to i, clockwise, in the plane
//   d_i   |v'_i - v'_o|
#include "wilt/venation/margin.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

void require(bool holds, const char* key, double value, const char* allowed) {
  if (!holds)
    throw Error(ErrorCode::configuration, fmt::format("{} = {}; it must be {}", key, value, allowed));
}

/// d(s) as the circle that it is: indices wrap.
class Circle {
 public:
  explicit Circle(const MarginProfile& profile)
      : profile_(profile), size_(static_cast<int>(profile.d.size())) {}

  int size() const { return size_; }
  int at(int index) const { return ((index % size_) + size_) % size_; }
  double d(int index) const { return profile_.d(at(index)); }

  /// The arc length from `from`, `steps` vertices on (backwards when negative), >= 0.
  double arc(int from, int steps) const {
    const int begin = steps < 0 ? at(from + steps) : from, end = steps < 0 ? from : at(from + steps);
    const double length = profile_.s(end) - profile_.s(begin);
    return length < 0.0 ? length + profile_.perimeter : length;
  }

  /// The least d on the way from `peak` to the next higher point, in steps of +1 or -1.
  double saddle(int peak, int step) const {
    double least = d(peak);
    for (int k = 1; k < size_ && d(peak + k * step) <= d(peak); ++k)
      least = std::min(least, d(peak + k * step));
    return least;
  }

 private:
  const MarginProfile& profile_;
  int size_;
};

double prominence(const Circle& circle, int peak) {
  return circle.d(peak) - std::max(circle.saddle(peak, -1), circle.saddle(peak, 1));
}

/// Whether nothing within `reach` on one side of `peak` is higher; of equals the first from the petiole
/// counts.
bool tops_one_side(const Circle& circle, int peak, int step, double reach) {
  for (int k = 1; k < circle.size() && (k == 1 || circle.arc(peak, k * step) <= reach); ++k) {
    const int other = circle.at(peak + k * step);
    if (circle.d(other) > circle.d(peak) || (circle.d(other) == circle.d(peak) && other < peak)) return false;
  }
  return true;
}

/// d_{r-k} < ... < d_{r-1} < d_r > d_{r+1} > ... > d_{r+k}.
bool rises_and_falls(const Circle& circle, int peak, int k) {
  if (2 * k >= circle.size()) return false;
  for (int i = 1; i <= k; ++i) {
    if (circle.d(peak - i) >= circle.d(peak - i + 1) || circle.d(peak + i) >= circle.d(peak + i - 1))
      return false;
  }
  return true;
}

}  // namespace

void PeakOptions::validate() const {
  require(window_vertices >= 1, "peaks.window_vertices", window_vertices, "at least 1");
  require(window_length >= 0.0 && window_length <= 0.5, "peaks.window_length", window_length, "in 0 to 0.5");
  require(min_prominence >= 0.0 && min_prominence <= 1.0, "peaks.min_prominence", min_prominence,
          "in 0 to 1");
}

MarginProfile expand_margin(const std::vector<VertexId>& margin, const Points2& flat, VertexId petiole) {
  const auto at = [&](VertexId v) { return Vec2(flat.row(v).transpose()); };
  const auto from_petiole = [&](VertexId v) { return (at(v) - at(petiole)).norm(); };
  MarginProfile profile;
  profile.vertices = margin;
  const auto first =
      std::min_element(profile.vertices.begin(), profile.vertices.end(),
                       [&](VertexId a, VertexId b) { return from_petiole(a) < from_petiole(b); });
  std::rotate(profile.vertices.begin(), first, profile.vertices.end());

  const int count = static_cast<int>(margin.size());
  profile.s.resize(count);
  profile.d.resize(count);
  for (int i = 0; i < count; ++i) {
    const VertexId v = profile.vertices[i], next = profile.vertices[(i + 1) % count];
    profile.s(i) = profile.perimeter;
    profile.d(i) = from_petiole(v);
    profile.perimeter += (at(next) - at(v)).norm();
  }
  return profile;
}

std::vector<Peak> find_peaks(const MarginProfile& profile, const PeakOptions& options) {
  options.validate();
  std::vector<Peak> peaks;
  if (profile.d.size() < 3) return peaks;
  const Circle circle(profile);
  const double reach = 0.5 * options.window_length * profile.perimeter;
  const double least = options.min_prominence * profile.d.maxCoeff();
  for (int i = 1; i < circle.size(); ++i) {  // 0 is the petiole
    if (options.rule == PeakRule::window) {
      if (rises_and_falls(circle, i, options.window_vertices)) peaks.push_back({i, prominence(circle, i)});
      continue;
    }
    if (!tops_one_side(circle, i, -1, reach) || !tops_one_side(circle, i, 1, reach)) continue;
    const double height = prominence(circle, i);
    if (height >= least && height > 0.0) peaks.push_back({i, height});
  }
  return peaks;
}

}  // namespace wilt
