#include "wilt/leaf/margin_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/leaf/necks.hpp"
#include "wilt/leaf/rings.hpp"

namespace wilt::detail {
namespace {

constexpr int kDense = 4;            // points per edge while smoothing
constexpr double kSmoothing = 0.6;   // standard deviation, edges
constexpr double kClearance = 0.45;  // of lattice points from the margin, edges; 0.433 fills evenly
constexpr int kSmallestHole = 5;     // samples
constexpr int kRoundsPerStage = 4;   // of smoothing between resamplings
constexpr double kThinnest = 0.45;   // thickness of the blade, edges

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

// Where a point to be kept is on a ring, as a share of the ring's length: it survives smoothing and
// resampling.
struct KeptPlace {
  std::size_t ring = 0;
  double share = 0.0;
  double distance = 1e300;  // from the point to the ring
};

std::size_t index_of(const KeptPlace& place, const Polyline& ring) {
  const std::vector<double> s = arc_lengths(ring);
  const auto above = std::lower_bound(s.begin(), s.end(), place.share * s.back());
  const auto i = static_cast<std::size_t>(above - s.begin());
  const bool below_is_nearer =
      i > 0 && place.share * s.back() - s[i - 1] < s[std::min(i, ring.size())] - place.share * s.back();
  return (below_is_nearer ? i - 1 : i) % ring.size();
}

// The nearest places of a polygon to some points, on its segments.
std::vector<KeptPlace> places_on(const Polyline& ring, const Polyline& points) {
  const std::vector<double> s = arc_lengths(ring);
  std::vector<KeptPlace> places(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 u = ring[(i + 1) % ring.size()] - ring[i];
      const double t =
          u.squaredNorm() > 0.0 ? std::clamp((points[k] - ring[i]).dot(u) / u.squaredNorm(), 0.0, 1.0) : 0.0;
      const double distance = (ring[i] + t * u - points[k]).norm();
      if (distance < places[k].distance) {
        places[k].distance = distance;
        places[k].share = (s[i] + t * u.norm()) / s.back();
      }
    }
  }
  return places;
}

// Resamples and smooths a ring in stages, so that the steps stay even while details vanish; `places` follow.
// False for a hole that is too small at this scale.
bool smooth_to_scale(const Polyline& ring, double edge, double smoothing, bool is_hole, Polyline& dense,
                     std::vector<KeptPlace>& places) {
  const double sigma = kDense * kSmoothing * smoothing;
  const int stages = std::max(1, static_cast<int>(std::lround(2.0 * sigma * sigma / kRoundsPerStage)));
  dense = ring;
  for (int stage = 0; stage <= stages; ++stage) {
    const double length = length_of(dense, true);
    if (is_hole && length < (stage < stages ? kSmallestHole : 3) * edge) return false;
    const int count = std::max(static_cast<int>(std::ceil(length / edge * kDense)), 3 * kDense);
    dense = resample_ring(dense, count);
    if (stage == stages) break;
    std::vector<std::size_t> indices;
    for (const KeptPlace& place : places) indices.push_back(index_of(place, dense));
    smooth_ring(dense, kRoundsPerStage);
    const std::vector<double> s = arc_lengths(dense);
    for (std::size_t k = 0; k < places.size(); ++k) places[k].share = s[indices[k]] / s.back();
  }
  return true;
}

// The dense indices that must become samples, ascending; places nearer than 0.6 edges share one.
std::vector<int> forced_samples(const std::vector<KeptPlace>& kept, std::size_t ring, const Polyline& dense) {
  std::vector<int> wanted;
  for (const KeptPlace& place : kept) {
    if (place.ring == ring) wanted.push_back(static_cast<int>(index_of(place, dense)));
  }
  std::sort(wanted.begin(), wanted.end());
  std::vector<int> apart;
  for (const int i : wanted) {
    if (apart.empty() || i - apart.back() > 0.6 * kDense) apart.push_back(i);
  }
  if (apart.empty()) apart.push_back(0);
  return apart;
}

}  // namespace

SampledMargin sample_margin(const std::vector<Polyline>& outline, const Polyline& keep, double edge,
                            double smoothing) {
  std::vector<Ring> rings;
  std::vector<KeptPlace> kept(keep.size());
  for (std::size_t r = 0; r < outline.size(); ++r) {
    Ring ring;
    std::vector<KeptPlace> here = places_on(outline[r], keep);
    if (!smooth_to_scale(outline[r], edge, smoothing, r > 0, ring.dense, here)) continue;
    for (std::size_t k = 0; k < keep.size(); ++k) {
      here[k].ring = rings.size();
      if (here[k].distance < kept[k].distance) kept[k] = here[k];
    }
    rings.push_back(std::move(ring));
  }
  for (std::size_t r = 0; r < rings.size(); ++r) {
    rings[r].samples = spread_samples(rings[r].dense, forced_samples(kept, r, rings[r].dense), edge);
  }
  uncross(rings);
  std::vector<Polyline> lines;
  for (const Ring& ring : rings) lines.push_back(sampled(ring));
  std::vector<Polyline> thick = lines;
  thicken_necks(thick, kThinnest * edge);
  if (!find_crossing(thick)) lines = std::move(thick);
  SampledMargin result;
  for (const Polyline& line : lines) {
    std::vector<int> indices;
    for (const Vec2& p : line) {
      indices.push_back(static_cast<int>(result.points.size()));
      result.points.push_back(p);
    }
    result.rings.push_back(std::move(indices));
  }
  for (const KeptPlace& place : kept) {
    const Ring& ring = rings[place.ring];
    const int sample = nearest_index(sampled(ring), ring.dense[index_of(place, ring.dense)]);
    result.kept.push_back(result.rings[place.ring][static_cast<std::size_t>(sample)]);
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
