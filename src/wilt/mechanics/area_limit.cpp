// Symbols: N area normal, n its unit vector, A = |N|/2, c_i the edge opposite vertex i: dN = c_i x dx_i.
// dA/dx_i = n x c_i / 2;  d2A/dx_i dx_j = ([c_i]^T (I - n n^T) [c_j]/|N| -+ [n])/2, - for j after i, [.]
// cross matrices.
#include "wilt/mechanics/area_limit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

using Eigen::Matrix3d;
using simd::kLanes;

constexpr int kGroups = 128;            // of eight faces per parallel task
constexpr double kMargin = 1.0 + 1e-9;  // of the first look, whose round-off is another

struct Triangle {
  std::array<Vec3, 3> opposite;  // c_i
  Vec3 normal;                   // n
  double length;                 // |N|

  Triangle(const Points3& x, const int* v) {
    for (int i = 0; i < 3; ++i) opposite[i] = (x.row(v[(i + 2) % 3]) - x.row(v[(i + 1) % 3])).transpose();
    normal = opposite[0].cross(opposite[1]);
    length = normal.norm();
    normal /= length;
  }
  double area() const { return 0.5 * length; }
  Vec3 gradient(int i) const { return 0.5 * normal.cross(opposite[i]); }
};

Matrix3d cross_matrix(const Vec3& a) {
  Matrix3d m;
  m << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return m;
}

Matrix3d area_hessian(const Triangle& t, int i, int j) {
  const Matrix3d across = Matrix3d::Identity() - t.normal * t.normal.transpose();
  Matrix3d block = cross_matrix(t.opposite[i]).transpose() * across * cross_matrix(t.opposite[j]) / t.length;
  if (j == (i + 1) % 3) block -= cross_matrix(t.normal);
  if (i == (j + 1) % 3) block += cross_matrix(t.normal);
  return 0.5 * block;
}

// psi(r) = (r_0/r - 1)^3 with its derivatives, for r < r_0.
struct Barrier {
  double value, slope, curvature;

  Barrier(double ratio, double threshold) {
    const double q = threshold / ratio, excess = q - 1.0;
    value = excess * excess * excess;
    slope = -3.0 * excess * excess * q / ratio;
    curvature = 6.0 * excess * q / (ratio * ratio) * (q + excess);
  }
};

// Whether a face of the group may have |N|^2 below its least one.
WILT_CLONES void find_squeezed(const double* x, const int* corners, const Number8* least, int begin, int end,
                               char* found) {
  for (int g = begin; g < end; ++g) {
    const int* of_group = corners + 3 * kLanes * g;
    const Point8 origin = simd::gather(x, of_group);
    const Point8 a = simd::gather(x, of_group + kLanes) - origin;
    const Point8 b = simd::gather(x, of_group + 2 * kLanes) - origin;
    const Point8 normal = cross(a, b);
    const auto sound = dot(normal, normal) >= least[g].lanes;
    found[g] = simd::sum(sound ? Double8{} : Double8{} + 1.0) > 0.0;
  }
}

}  // namespace

AreaLimit::AreaLimit(const Faces& faces, const Points3& rest, const Eigen::VectorXd& stiffness,
                     double threshold)
    : Energy(faces), rest_areas_(faces.rows()), stiffness_(stiffness), threshold_(threshold) {
  if (!(threshold > 0.0) || !(threshold < 1.0))
    throw Error(
        ErrorCode::configuration,
        fmt::format("the area limit starts at a share of {}; it must lie between 0 and 1", threshold));
  detail::require_count("stiffnesses", stiffness.size(), element_count());
  detail::require_values("the limiting stiffness of face", stiffness, 0.0, false);
  for (int f = 0; f < element_count(); ++f) rest_areas_[f] = Triangle(rest, vertices(f)).area();
  detail::require_values("the rest area of face", rest_areas_, 0.0, true);
  for (int first = 0; first < element_count(); first += kLanes) {
    least8_.emplace_back();
    for (int l = 0; l < kLanes; ++l) {
      const int f = std::min(first + l, element_count() - 1);
      least8_.back().lanes[l] = std::pow(kMargin * 2.0 * threshold * rest_areas_[f], 2);
    }
    for (int i = 0; i < 3; ++i) {
      for (int l = 0; l < kLanes; ++l)
        corners8_.push_back(vertices(std::min(first + l, element_count() - 1))[i]);
    }
  }
}

// The faces below the threshold, ascending. Few are, and seldom: eight are looked at at once.
std::vector<int> AreaLimit::squeezed(const Points3& x) const {
  const int groups = static_cast<int>(least8_.size());
  std::vector<char> found(groups);
  parallel_for(groups, kGroups, [&](int begin, int end) {
    find_squeezed(x.data(), corners8_.data(), least8_.data(), begin, end, found.data());
  });
  std::vector<int> faces;
  for (int g = 0; g < groups; ++g) {
    if (!found[g]) continue;
    for (int f = kLanes * g; f < std::min(kLanes * (g + 1), element_count()); ++f) {
      if (!(Triangle(x, vertices(f)).area() >= threshold_ * rest_areas_[f])) faces.push_back(f);
    }
  }
  return faces;
}

double AreaLimit::energy(const Points3& x) const {
  double sum = 0.0;
  for (const int f : squeezed(x)) {
    const double ratio = Triangle(x, vertices(f)).area() / rest_areas_[f];
    sum += stiffness_[f] * rest_areas_[f] * Barrier(ratio, threshold_).value;
  }
  return sum;
}

void AreaLimit::add_gradient(const Points3& x, Points3& gradient) const {
  for (const int f : squeezed(x)) {
    const Triangle triangle(x, vertices(f));
    const double slope = stiffness_[f] * Barrier(triangle.area() / rest_areas_[f], threshold_).slope;
    for (int i = 0; i < 3; ++i) gradient.row(vertices(f)[i]) += slope * triangle.gradient(i).transpose();
  }
}

void AreaLimit::add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const {
  for (const int f : squeezed(x)) {
    const Triangle triangle(x, vertices(f));
    const Barrier barrier(triangle.area() / rest_areas_[f], threshold_);
    int pair = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j, ++pair) {
        Matrix3d block =
            barrier.curvature / rest_areas_[f] * triangle.gradient(i) * triangle.gradient(j).transpose();
        if (curvature == Curvature::exact) block += barrier.slope * area_hessian(triangle, i, j);
        block *= scale * stiffness_[f];
        matrix.add(slots(f)[pair], block);
      }
    }
  }
}

}  // namespace wilt
