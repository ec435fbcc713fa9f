#include "wilt/leaf/margin_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/leaf/rings.hpp"

namespace wilt::detail {
namespace {

constexpr int kDense = 4;            // points per edge while smoothing
constexpr double kSmoothing = 0.6;   // standard deviation, edges
constexpr double kClearance = 0.45;  // of lattice points from the margin, edges; 0.433 fills evenly
constexpr int kSmallestHole = 5;     // samples

// A ring being sampled: its dense form and the indices of the samples, ascending.
struct Ring {
  Polyline dense;
  std::vector<int> samples;
};

std::vector<double> arc_lengths(const Polyline& ring) {
  std::vector<double> s(ring.size() + 1, 0.0);
  for (std::size_t i = 0; i < ring.size(); ++i)
    s[i + 1] = s[i] + (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return s;
}

// Spreads samples evenly between the forced ones (ascending, at least one).
std::vector<int> spread_samples(const Polyline& dense, const std::vector<int>& forced, double edge) {
  const std::vector<double> s = arc_lengths(dense);
  const int n = static_cast<int>(dense.size());
  const auto at = [&](int i) { return s[static_cast<std::size_t>(i % n)] + (i >= n ? s.back() : 0.0); };
  const int fewest = forced.size() == 1 ? kSmallestHole : forced.size() == 2 ? 2 : 1;
  std::vector<int> samples;
  for (std::size_t k = 0; k < forced.size(); ++k) {
    const int begin = forced[k];
    const int end = k + 1 < forced.size() ? forced[k + 1] : forced[0] + n;
    const int count = std::max(fewest, static_cast<int>(std::lround((at(end) - at(begin)) / edge)));
    int i = begin;
    for (int j = 0; j < count; ++j) {
      const double target = at(begin) + (at(end) - at(begin)) * j / count;
      while (i + 1 < end && std::abs(at(i + 1) - target) <= std::abs(at(i) - target)) ++i;
      if (samples.empty() || samples.back() != i) samples.push_back(i);
    }
  }
  for (int& i : samples) i %= n;
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return samples;
}

int nearest_index(const Polyline& ring, const Vec2& p) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(ring.size()); ++i) {
    if ((ring[static_cast<std::size_t>(i)] - p).squaredNorm() <
        (ring[static_cast<std::size_t>(best)] - p).squaredNorm()) {
      best = i;
    }
  }
  return best;
}

// Adds the middle of the segment after sample `index`; false when there is no dense point left in between.
bool split_segment(Ring& ring, int index) {
  const int n = static_cast<int>(ring.dense.size());
  const auto k = static_cast<std::size_t>(index);
  const int begin = ring.samples[k];
  const int end = k + 1 < ring.samples.size() ? ring.samples[k + 1] : ring.samples[0] + n;
  if (end - begin < 2) return false;
  ring.samples.push_back(((begin + end) / 2) % n);
  std::sort(ring.samples.begin(), ring.samples.end());
  return true;
}

Polyline sampled(const Ring& ring) {
  Polyline points;
  for (const int i : ring.samples) points.push_back(ring.dense[static_cast<std::size_t>(i)]);
  return points;
}

// Where straight segments cut across each other (a narrow sinus), finer ones follow the smooth curve.
void uncross(std::vector<Ring>& rings) {
  constexpr int kMostSplits = 400;
  for (int split = 0; split < kMostSplits; ++split) {
    std::vector<Polyline> lines;
    for (const Ring& ring : rings) lines.push_back(sampled(ring));
    const auto crossing = find_crossing(lines);
    if (!crossing) return;
    // The later segment of one ring first: its split does not renumber the other.
    bool done = false;
    if (crossing->ring1 == crossing->ring2) {
      Ring& ring = rings[static_cast<std::size_t>(crossing->ring1)];
      done |= split_segment(ring, std::max(crossing->index1, crossing->index2));
      done |= split_segment(ring, std::min(crossing->index1, crossing->index2));
    } else {
      done |= split_segment(rings[static_cast<std::size_t>(crossing->ring1)], crossing->index1);
      done |= split_segment(rings[static_cast<std::size_t>(crossing->ring2)], crossing->index2);
    }
    if (!done) return;
  }
}

}  // namespace

SampledMargin sample_margin(const std::vector<Polyline>& outline, const Polyline& keep, double edge,
                            double smoothing) {
  std::vector<Ring> rings;
  std::vector<std::vector<int>> forced;
  std::vector<std::pair<std::size_t, int>> kept_at(keep.size());  // ring, dense index
  std::vector<double> kept_distance(keep.size(), 1e300);
  const double sigma = kDense * kSmoothing * smoothing;
  for (std::size_t r = 0; r < outline.size(); ++r) {
    const int count = static_cast<int>(std::ceil(length_of(outline[r], true) / edge * kDense));
    if (r > 0 && count < kDense * kSmallestHole) continue;
    Ring ring;
    ring.dense = resample_ring(outline[r], std::max(count, 3 * kDense));
    for (std::size_t k = 0; k < keep.size(); ++k) {
      const int i = nearest_index(ring.dense, keep[k]);
      const double distance = (ring.dense[static_cast<std::size_t>(i)] - keep[k]).norm();
      if (distance < kept_distance[k]) {
        kept_distance[k] = distance;
        kept_at[k] = {rings.size(), i};
      }
    }
    smooth_ring(ring.dense, static_cast<int>(std::lround(2.0 * sigma * sigma)));
    if (r > 0 && length_of(ring.dense, true) < 3.0 * edge) continue;
    rings.push_back(std::move(ring));
  }
  SampledMargin result;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    // Kept points nearer than 0.6 edges share a sample.
    std::vector<int> wanted;
    for (std::size_t k = 0; k < keep.size(); ++k) {
      if (kept_at[k].first == r) wanted.push_back(kept_at[k].second);
    }
    std::sort(wanted.begin(), wanted.end());
    std::vector<int> apart;
    for (const int i : wanted) {
      if (apart.empty() || i - apart.back() > 0.6 * kDense) apart.push_back(i);
    }
    if (apart.empty()) apart.push_back(0);
    rings[r].samples = spread_samples(rings[r].dense, apart, edge);
  }
  uncross(rings);
  std::vector<int> first;
  for (const Ring& ring : rings) {
    first.push_back(static_cast<int>(result.points.size()));
    std::vector<int> indices;
    const Polyline points = sampled(ring);
    for (const Vec2& p : points) {
      indices.push_back(static_cast<int>(result.points.size()));
      result.points.push_back(p);
    }
    result.rings.push_back(std::move(indices));
    result.length += length_of(points, true);
    result.area += (first.size() == 1 ? 1.0 : -1.0) * std::abs(signed_area(points));
  }
  for (std::size_t k = 0; k < keep.size(); ++k) {
    const Ring& ring = rings[kept_at[k].first];
    const Vec2& target = ring.dense[static_cast<std::size_t>(kept_at[k].second)];
    result.kept.push_back(first[kept_at[k].first] + nearest_index(sampled(ring), target));
  }
  return result;
}

namespace {

// The segments of the rings, found by the cells of a grid that they come near to.
class NearMargin {
 public:
  NearMargin(const SampledMargin& margin, double cell, double reach) : cell_(cell), reach_(reach) {
    low_ = high_ = margin.points[0];
    for (const Vec2& p : margin.points) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    columns_ = static_cast<int>((high_.x() - low_.x()) / cell_) + 1;
    rows_ = static_cast<int>((high_.y() - low_.y()) / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (const auto& ring : margin.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        enter(margin.points[static_cast<std::size_t>(ring[i])],
              margin.points[static_cast<std::size_t>(ring[(i + 1) % ring.size()])]);
      }
    }
  }

  bool is_near(const Vec2& p) const {
    const int c = column(p.x()), r = row(p.y());
    for (const auto& [a, b] : cells_[index(c, r)]) {
      const Vec2 u = b - a;
      const double t = std::clamp((p - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
      if ((p - a - t * u).squaredNorm() < reach_ * reach_) return true;
    }
    return false;
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / cell_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / cell_), 0, rows_ - 1); }
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }
  void enter(const Vec2& a, const Vec2& b) {
    for (int r = row(std::min(a.y(), b.y()) - reach_); r <= row(std::max(a.y(), b.y()) + reach_); ++r) {
      for (int c = column(std::min(a.x(), b.x()) - reach_); c <= column(std::max(a.x(), b.x()) + reach_);
           ++c) {
        cells_[index(c, r)].emplace_back(a, b);
      }
    }
  }

  double cell_, reach_;
  Vec2 low_, high_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::pair<Vec2, Vec2>>> cells_;
};

}  // namespace

Polyline hexagonal_points(const SampledMargin& margin, double edge) {
  const NearMargin near(margin, 2.0 * edge, kClearance * edge);
  double low_x = margin.points[0].x(), low_y = margin.points[0].y(), high_y = low_y;
  for (const Vec2& p : margin.points) {
    low_x = std::min(low_x, p.x());
    low_y = std::min(low_y, p.y());
    high_y = std::max(high_y, p.y());
  }
  // Where the rings cross each row of the lattice.
  const double row_height = 0.5 * std::sqrt(3.0) * edge;
  const auto row_count = static_cast<std::size_t>((high_y - low_y) / row_height) + 1;
  std::vector<std::vector<double>> crossings(row_count);
  const auto y_of = [&](int row) { return low_y + (row + 0.5) * row_height; };
  for (const auto& ring : margin.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec2 a = margin.points[static_cast<std::size_t>(ring[i])];
      Vec2 b = margin.points[static_cast<std::size_t>(ring[(i + 1) % ring.size()])];
      if (a.y() > b.y()) std::swap(a, b);
      int row = std::max(0, static_cast<int>((a.y() - low_y) / row_height) - 1);
      for (; row < static_cast<int>(row_count) && y_of(row) <= b.y(); ++row) {
        if (y_of(row) <= a.y()) continue;
        const double t = (y_of(row) - a.y()) / (b.y() - a.y());
        crossings[static_cast<std::size_t>(row)].push_back(a.x() + t * (b.x() - a.x()));
      }
    }
  }
  Polyline points;
  for (int row = 0; row < static_cast<int>(row_count); ++row) {
    std::vector<double>& x = crossings[static_cast<std::size_t>(row)];
    std::sort(x.begin(), x.end());
    const double shift = low_x + (row % 2 == 0 ? 0.25 : 0.75) * edge;
    for (std::size_t k = 0; k + 1 < x.size(); k += 2) {
      for (double i = std::ceil((x[k] - shift) / edge); shift + i * edge < x[k + 1]; i += 1.0) {
        const Vec2 p(shift + i * edge, y_of(row));
        if (!near.is_near(p)) points.push_back(p);
      }
    }
  }
  return points;
}

}  // namespace wilt::detail
