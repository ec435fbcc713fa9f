#include "wilt/leaf/curves.hpp"

#include <algorithm>
#include <cmath>

namespace wilt::detail {

double length_of(const Polyline& points, bool closed) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  if (closed && !points.empty()) length += (points.front() - points.back()).norm();
  return length;
}

double signed_area(const Polyline& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  }
  return 0.5 * twice;
}

bool is_inside(const Polyline& ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  }
  return inside;
}

Polyline spline_through(const Polyline& points, int per_span) {
  Polyline result;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec2 p1 = points[i];
    const Vec2 p2 = points[i + 1];
    const Vec2 p0 = i > 0 ? points[i - 1] : Vec2(2.0 * p1 - p2);
    const Vec2 p3 = i + 2 < n ? points[i + 2] : Vec2(2.0 * p2 - p1);
    const double t1 = std::sqrt((p1 - p0).norm());
    const double t2 = t1 + std::sqrt((p2 - p1).norm());
    const double t3 = t2 + std::sqrt((p3 - p2).norm());
    for (int k = 0; k < per_span; ++k) {
      const double t = t1 + (t2 - t1) * k / per_span;
      const Vec2 a1 = ((t1 - t) * p0 + t * p1) / t1;
      const Vec2 a2 = ((t2 - t) * p1 + (t - t1) * p2) / (t2 - t1);
      const Vec2 a3 = ((t3 - t) * p2 + (t - t2) * p3) / (t3 - t2);
      const Vec2 b1 = ((t2 - t) * a1 + t * a2) / t2;
      const Vec2 b2 = ((t3 - t) * a2 + (t - t1) * a3) / (t3 - t1);
      result.push_back(((t2 - t) * b1 + (t - t1) * b2) / (t2 - t1));
    }
  }
  if (n > 0) result.push_back(points.back());
  return result;
}

namespace {

// count + 1 points at even arc length from the first to the last point.
Polyline resample(const Polyline& points, int count) {
  std::vector<double> s(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
  Polyline result;
  result.reserve(static_cast<std::size_t>(count) + 1);
  std::size_t span = 0;
  for (int k = 0; k < count; ++k) {
    const double at = s.back() * k / count;
    while (span + 2 < points.size() && s[span + 1] <= at) ++span;
    const double width = s[span + 1] - s[span];
    const double t = width > 0.0 ? (at - s[span]) / width : 0.0;
    result.push_back((1.0 - t) * points[span] + t * points[span + 1]);
  }
  result.push_back(points.back());
  return result;
}

}  // namespace

Polyline resample_ring(const Polyline& ring, int count) {
  Polyline closed = ring;
  closed.push_back(ring.front());
  Polyline result = resample(closed, count);
  result.pop_back();
  return result;
}

Polyline resample_open(const Polyline& points, double step) {
  return resample(points, std::max(1, static_cast<int>(std::ceil(length_of(points, false) / step))));
}

void smooth_ring(Polyline& ring, int rounds) {
  Polyline before;
  const std::size_t n = ring.size();
  for (int round = 0; round < rounds; ++round) {
    before = ring;
    for (std::size_t i = 0; i < n; ++i) {
      ring[i] = 0.25 * before[(i + n - 1) % n] + 0.5 * before[i] + 0.25 * before[(i + 1) % n];
    }
  }
}

}  // namespace wilt::detail
