// Finding the base of a leaf from the shape of its margin.
//
// Mirror symmetry of a closed curve z(s), s in [0, 1), complex, its centroid at 0, walked at even speed: the
// reflection that maps z(c - s) to z(s) best has the axis direction arg F(c) / 2 with
//     F(c) = integral z(s) z(c - s) ds,    S(c) = |F(c)| / integral |z|^2  in [0, 1],
// and its axis leaves the curve at s = c/2 and c/2 + 1/2. S = 1 for perfect symmetry.
#include "wilt/leaf/petiole.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using Complex = std::complex<double>;
using Curve = std::vector<Complex>;

constexpr int kSamples = 720;
constexpr double kWindow = 0.045 * kSamples;  // how far from the axis the base may lie along the margin
constexpr double kLeastNotch = 0.02;          // shallower ones are bends, in units of the leaf's length
constexpr double kBlunt = 0.75;               // chord over arc of an end that is no point
constexpr double kSureLead = 0.25;            // a lead in score that gives a confidence of 63 %

double dot(const Complex& a, const Complex& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}

double cross(const Complex& a, const Complex& b) {
  return a.real() * b.imag() - a.imag() * b.real();
}

Complex at(const Curve& curve, int i) {
  const int n = static_cast<int>(curve.size());
  return curve[((i % n) + n) % n];
}

// The margin at even arc length, counter-clockwise, and the arc length (0 to kSamples) of every margin point.
struct Sampled {
  Curve curve;
  std::vector<double> where;  // #M
  double length = 0.0;
};

Sampled sample(const Points2& margin) {
  const int m = static_cast<int>(margin.rows());
  double twice_area = 0.0;
  for (int i = 0; i < m; ++i) {
    const int j = (i + 1) % m;
    twice_area += margin(i, 0) * margin(j, 1) - margin(j, 0) * margin(i, 1);
  }
  const auto index = [&](int i) { return twice_area >= 0 ? i % m : (2 * m - i) % m; };
  const auto point = [&](int i) { return Complex(margin(index(i), 0), margin(index(i), 1)); };
  std::vector<double> start(m + 1, 0.0);
  for (int i = 0; i < m; ++i) start[i + 1] = start[i] + std::abs(point(i + 1) - point(i));

  Sampled result;
  result.length = start.back();
  result.where.resize(m);
  for (int i = 0; i < m; ++i) result.where[index(i)] = start[i] / result.length * kSamples;
  int i = 0;
  for (int k = 0; k < kSamples; ++k) {
    const double s = result.length * k / kSamples;
    while (i + 1 < m && start[i + 1] <= s) ++i;
    const double span = start[i + 1] - start[i];
    const double t = span > 0 ? (s - start[i]) / span : 0.0;
    result.curve.push_back((1 - t) * point(i) + t * point(i + 1));
  }
  return result;
}

// A periodic Gaussian of `deviation` samples.
Curve smoothed(const Curve& curve, double deviation) {
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  Curve result(curve.size());
  double total = 0.0;
  std::vector<double> weights;
  for (int j = -reach; j <= reach; ++j) {
    weights.push_back(std::exp(-0.5 * j * j / (deviation * deviation)));
    total += weights.back();
  }
  for (int i = 0; i < static_cast<int>(curve.size()); ++i) {
    for (int j = -reach; j <= reach; ++j) result[i] += weights[j + reach] / total * at(curve, i + j);
  }
  return result;
}

Complex area_centroid(const Curve& curve) {
  Complex sum = 0.0;
  double area = 0.0;
  for (int i = 0; i < static_cast<int>(curve.size()); ++i) {
    const Complex a = curve[i], b = at(curve, i + 1);
    const double c = cross(a, b);
    area += c;
    sum += c * (a + b) / 3.0;
  }
  return sum / area;
}

// One end of one candidate axis, and what speaks for its being the base.
struct End {
  int at = 0;              // half samples: the axis leaves the curve at sample at/2
  Complex outward;         // unit vector along the axis, towards this end
  double symmetry = 0.0;   // S
  double notch = 0.0;      // how far the curve draws back from the shoulders beside it, per leaf length
  double bluntness = 0.0;  // chord over arc around the end: 1 straight, small for a sharp tip
  double width = 0.0;      // how far the area's centroid lies towards this end, -0.5 to 0.5
  double aspect = 1.0;     // extent along the axis over extent across it
  double score = 0.0;
};

class BaseFinder {
 public:
  explicit BaseFinder(const Curve& fine)
      : curve_(smoothed(fine, 0.006 * kSamples)), centroid_(area_centroid(curve_)) {
    Complex mean = 0.0;
    for (const Complex& z : curve_) mean += z / static_cast<double>(kSamples);
    for (const Complex& z : curve_) centred_.push_back(z - mean);
    for (int c = 0; c < kSamples; ++c) add_axis(c);
  }

  // The likeliest base.
  const End& best() const {
    return *std::max_element(ends_.begin(), ends_.end(),
                             [](const End& a, const End& b) { return a.score < b.score; });
  }

  // How much better the best is than any end that is not beside it.
  double lead() const {
    const End& winner = best();
    double rival = -1e9;
    for (const End& end : ends_) {
      const int apart = std::abs(end.at - winner.at), period = 2 * kSamples;
      if (std::min(apart, period - apart) > period / 10) rival = std::max(rival, end.score);
    }
    return winner.score - rival;
  }

 private:
  void add_axis(int c) {
    Complex f = 0.0;
    double norm = 0.0;
    for (int j = 0; j < kSamples; ++j) {
      f += centred_[j] * at(centred_, c - j);
      norm += std::norm(centred_[j]);
    }
    const Complex axis = std::polar(1.0, 0.5 * std::arg(f));
    const Complex chord = at(curve_, c / 2) - at(curve_, c / 2 + kSamples / 2);
    const Complex outward = dot(chord, axis) >= 0 ? axis : -axis;
    std::array<End, 2> ends;
    for (const int k : {0, 1}) {
      ends[k].at = c + k * kSamples;
      ends[k].outward = k == 0 ? outward : -outward;
      ends[k].symmetry = std::abs(f) / norm;
      measure(ends[k]);
    }
    for (const int k : {0, 1}) {
      ends[k].score = score(ends[k], ends[1 - k]);
      ends_.push_back(ends[k]);
    }
  }

  // The weights separate the bases of the six species and of traced leaves from every other point of their
  // margins; differences in symmetry of 0.03 between the true axis and the next best are usual.
  static double score(const End& end, const End& opposite) {
    const auto blunt = [](const End& e) { return std::max(e.bluntness, std::min(1.0, 10.0 * e.notch)); };
    return -20.0 * (1.0 - end.symmetry) + 3.0 * std::min(end.notch, 0.15) + 3.0 * end.width +
           0.4 * (blunt(end) - blunt(opposite)) - 2.0 * std::max(0.0, 0.6 - end.aspect);
  }

  void measure(End& end) const {
    const auto height = [&](int i) { return dot(at(curve_, i), end.outward); };
    const auto side = [&](int i) { return cross(end.outward, at(curve_, i)); };
    double top = height(0), bottom = top, right_most = side(0), left_most = right_most;
    for (int i = 1; i < kSamples; ++i) {
      top = std::max(top, height(i));
      bottom = std::min(bottom, height(i));
      right_most = std::min(right_most, side(i));
      left_most = std::max(left_most, side(i));
    }
    const double extent = top - bottom;
    const int middle = end.at / 2, reach = kSamples / 6;
    double left = height(middle), right = left;
    for (int k = 1; k <= reach; ++k) {
      left = std::max(left, height(middle - k));
      right = std::max(right, height(middle + k));
    }
    end.aspect = extent / (left_most - right_most);
    end.notch = (std::min(left, right) - height(middle)) / extent;
    const int arm = kSamples / 24;
    double arc = 0.0;
    for (int k = -arm; k < arm; ++k) arc += std::abs(at(curve_, middle + k + 1) - at(curve_, middle + k));
    end.bluntness = std::abs(at(curve_, middle + arm) - at(curve_, middle - arm)) / arc;
    end.width = (dot(centroid_, end.outward) - bottom) / extent - 0.5;
  }

  Curve curve_, centred_;
  Complex centroid_;
  std::vector<End> ends_;
};

enum class BaseKind { notch, point, flat };

BaseKind kind_of(const End& end) {
  if (end.notch > kLeastNotch) return BaseKind::notch;
  return end.bluntness < kBlunt ? BaseKind::point : BaseKind::flat;
}

// How sharply the curve bends at `s`: its distance from the chord between the points an arm to either side,
// per arm.
double bend_at(const Curve& curve, double s) {
  const int middle = static_cast<int>(std::lround(s)), arm = kSamples / 50;
  const Complex chord = at(curve, middle + arm) - at(curve, middle - arm);
  const double reach = std::abs(at(curve, middle) - at(curve, middle - arm));
  return std::abs(cross(at(curve, middle) - at(curve, middle - arm), chord)) /
         (std::abs(chord) * std::max(reach, 1e-300));
}

// The margin point that is the base: the deepest point of a notch, the outermost of a pointed end, or else
// the sharpest bend near the axis.
int base_point(const Points2& margin, const Sampled& sampled, const End& end) {
  const BaseKind kind = kind_of(end);
  int best = 0;
  double least = 1e300;
  for (int i = 0; i < static_cast<int>(margin.rows()); ++i) {
    double apart = std::abs(sampled.where[i] - 0.5 * end.at);
    apart = std::min(apart, kSamples - apart) / kWindow;
    const double height = dot(Complex(margin(i, 0), margin(i, 1)), end.outward);
    double cost = kind == BaseKind::notch ? height : -height;
    if (kind == BaseKind::flat) cost = 0.3 * apart * apart - bend_at(sampled.curve, sampled.where[i]);
    if (kind != BaseKind::flat && apart > 1.0) continue;
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

const char* reason_for(const End& end) {
  switch (kind_of(end)) {
    case BaseKind::notch:
      return "the notch on the axis of symmetry";
    case BaseKind::point:
      return "the wider, blunter of the two pointed ends of the axis of symmetry";
    default:
      return "the blunt, wide end of the axis of symmetry";
  }
}

}  // namespace

PetioleGuess find_petiole(const Points2& margin) {
  WILT_CHECK(margin.rows() >= 3, margin.rows());
  const Sampled sampled = sample(margin);
  const BaseFinder finder(sampled.curve);
  const End& end = finder.best();
  PetioleGuess guess;
  guess.index = base_point(margin, sampled, end);
  guess.confidence = 1.0 - std::exp(-std::max(0.0, finder.lead()) / kSureLead);
  guess.reason = reason_for(end);
  return guess;
}

void place_in_leaf_frame(Leaf& leaf, const Points3& file_positions, VertexId petiole,
                         double metres_per_unit) {
  const Vec3 origin = file_positions.row(petiole).transpose();
  const Vec3 normal = area_vector(leaf.mesh, file_positions);
  Vec3 apex = Vec3::Zero();
  for (const VertexId v : leaf.mesh.vertices()) {
    const Vec3 arm = file_positions.row(v).transpose() - origin;
    if (arm.squaredNorm() > apex.squaredNorm()) apex = arm;
  }
  const Vec3 z = normal.normalized();
  const Vec3 y = apex - apex.dot(z) * z;
  if (!(normal.norm() > 1e-12 * apex.squaredNorm()) || !(y.norm() > 1e-6 * apex.norm()))
    throw Error(ErrorCode::input,
                "the surface has no upper side: its faces look in all directions; a leaf blade is a sheet "
                "that is nearly flat");
  Eigen::Matrix3d axes;
  axes.col(2) = z;
  axes.col(1) = y.normalized();
  axes.col(0) = axes.col(1).cross(z);
  leaf.petiole = petiole;
  leaf.positions = (file_positions.rowwise() - origin.transpose()) * axes * metres_per_unit;
  leaf.placement.rotation = axes;
  leaf.placement.translation = origin;
  leaf.placement.scale = 1.0 / metres_per_unit;
}

Leaf with_petiole(Leaf leaf, const Vec2& wanted) {
  const auto distance = [&](VertexId v) {
    return (leaf.positions.row(v).head<2>().transpose() - wanted).squaredNorm();
  };
  const std::vector<VertexId>& margin = margin_loop(leaf.mesh, leaf.positions);
  const VertexId petiole = *std::min_element(
      margin.begin(), margin.end(), [&](VertexId a, VertexId b) { return distance(a) < distance(b); });
  const Vec2 place = 1000.0 * leaf.positions.row(petiole).head<2>().transpose();
  leaf.notes.push_back(
      fmt::format("petiole as given: the margin vertex at ({:.4g}, {:.4g}) mm, {:.3g} mm away", place.x(),
                  place.y(), 1000.0 * std::sqrt(distance(petiole))));
  place_in_leaf_frame(leaf, Points3(leaf.positions), petiole, 1.0);
  leaf.placement = Placement();
  return leaf;
}

}  // namespace wilt
