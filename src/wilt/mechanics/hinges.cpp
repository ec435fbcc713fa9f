// Symbols: theta signed dihedral angle, W the weight min(3 l^2/a, 12), k the stiffness (Grinspun et al.
// 2003).
#include "wilt/mechanics/hinges.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/argument_checks.hpp"
#include "wilt/mechanics/hinge_geometry.hpp"
#include "wilt/mechanics/hinge_lanes.hpp"

namespace wilt {
namespace {

using detail::SinglePoint;
using simd::kLanes;

constexpr double kLargestWeight = 12.0;
constexpr int kGroups = 64;     // of hinges,
constexpr int kVertices = 512;  // vertices
constexpr int kSlots = 2048;    // and blocks per parallel task

std::array<Vec3, 4> corners(const Points3& x, const int* v) {
  return {x.row(v[0]).transpose(), x.row(v[1]).transpose(), x.row(v[2]).transpose(), x.row(v[3]).transpose()};
}

double rest_weight(const std::array<Vec3, 4>& x) {
  const Vec3 edge = x[1] - x[0];
  const double area = 0.5 * (edge.cross(x[2] - x[0]).norm() + edge.cross(x[3] - x[0]).norm());
  const double length2 = edge.squaredNorm();
  return 3.0 * length2 >= kLargestWeight * area ? kLargestWeight : 3.0 * length2 / area;
}

// Groups of eight hinges and the positions they are at.
struct Pass {
  const double* x;
  const int* corners;
  const Number8 *moduli, *rest_angles;

  WILT_INLINE detail::HingeLanes lanes(int group) const {
    return detail::hinge_lanes(x, corners + 4 * kLanes * group);
  }
};

WILT_CLONES void angles_of_groups(const Pass& pass, int begin, int end, double* angles) {
  for (int g = begin; g < end; ++g) {
    const detail::HingeLanes hinges = pass.lanes(g);
    simd::store(angles + kLanes * g, hinges.sound * hinges.angle);
  }
}

WILT_CLONES double energy_of_groups(const Pass& pass, int begin, int end) {
  Double8 sum{};
  for (int g = begin; g < end; ++g) {
    const detail::HingeLanes hinges = pass.lanes(g);
    const Double8 bend = hinges.angle - pass.rest_angles[g].lanes;
    sum += hinges.sound * pass.moduli[g].lanes * bend * bend;
  }
  return 0.5 * simd::sum(sum);
}

// To each corner k W (theta - theta_rest) d theta/dx.
WILT_CLONES void gradients_of_groups(const Pass& pass, int begin, int end, Point4* of_corners) {
  Point4 points[kLanes];
  for (int g = begin; g < end; ++g) {
    const detail::HingeLanes hinges = pass.lanes(g);
    const Double8 torque = hinges.sound * pass.moduli[g].lanes * (hinges.angle - pass.rest_angles[g].lanes);
    for (int a = 0; a < 4; ++a) {
      simd::store_points(points, torque * hinges.gradient[a]);
      for (int l = 0; l < kLanes; ++l) of_corners[4 * (kLanes * g + l) + a] = points[l];
    }
  }
}

// To each corner sqrt(scale k W) d theta/dx.
WILT_CLONES void slopes_of_groups(const Pass& pass, double scale, int begin, int end,
                                  SinglePoint* of_corners) {
  Point4 points[kLanes];
  for (int g = begin; g < end; ++g) {
    const detail::HingeLanes hinges = pass.lanes(g);
    const Double8 root = hinges.sound * simd::sqrt(scale * pass.moduli[g].lanes);
    for (int a = 0; a < 4; ++a) {
      simd::store_points(points, root * hinges.gradient[a]);
      for (int l = 0; l < kLanes; ++l)
        of_corners[4 * (kLanes * g + l) + a].xyz = __builtin_convertvector(points[l].xyz, detail::Single4);
    }
  }
}

WILT_CLONES void add_outer_products(const IndexLists& slot_corners, const SinglePoint* slopes, int begin,
                                    int end, float* blocks) {
  for (int s = begin; s < end; ++s) {
    const auto list = slot_corners[s];
    if (list.empty()) continue;
    detail::SingleBlock block = detail::load_block(blocks, s);
    for (const int code : list)
      detail::add_outer(block, slopes[code / 4].xyz, slopes[code / 16 * 4 + code % 4].xyz);
    detail::store_block(blocks, s, block);
  }
}

}  // namespace

Stencil hinge_stencil(const Faces& faces) {
  struct Side {
    int low, high, opposite;
    bool forward;  // the face runs low -> high
  };
  std::vector<Side> sides;
  for (int f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, k), to = faces(f, (k + 1) % 3);
      sides.push_back({std::min(from, to), std::max(from, to), faces(f, (k + 2) % 3), from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.opposite} < std::array{b.low, b.high, b.opposite};
  });
  std::vector<std::array<int, 4>> hinges;
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const Side &a = sides[s], &b = sides[s + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const bool third = s + 2 < sides.size() && sides[s + 2].low == a.low && sides[s + 2].high == a.high;
    if (third || a.forward == b.forward)
      throw Error(ErrorCode::input,
                  fmt::format("the faces at edge {}-{} do not make an oriented surface; orient "
                              "them alike and keep two per edge",
                              a.low, a.high));
    hinges.push_back(
        {a.low, a.high, a.forward ? a.opposite : b.opposite, a.forward ? b.opposite : a.opposite});
    ++s;
  }
  Stencil stencil(static_cast<int>(hinges.size()), 4);
  for (std::size_t h = 0; h < hinges.size(); ++h) {
    for (int k = 0; k < 4; ++k) stencil(static_cast<int>(h), k) = hinges[h][k];
  }
  return stencil;
}

double hinge_angle(const Vec3& e0, const Vec3& e1, const Vec3& left, const Vec3& right) {
  return detail::hinge_derivatives({e0, e1, left, right}).angle;
}

Hinges::Hinges(const Stencil& stencil, const Points3& rest, const Eigen::VectorXd& stiffness)
    : Energy(stencil) {
  if (stencil.cols() != 4)
    throw Error(ErrorCode::configuration,
                fmt::format("a hinge has 4 vertices, not {}; take them from hinge_stencil", stencil.cols()));
  weights_.resize(element_count());
  for (int h = 0; h < element_count(); ++h) weights_[h] = rest_weight(corners(rest, vertices(h)));
  group_corners(static_cast<int>(rest.rows()));
  set_rest_angles(angles(rest));
  set_stiffness(stiffness);
}

void Hinges::group_corners(int vertex_count) {
  const int groups = (element_count() + kLanes - 1) / kLanes;
  moduli8_.resize(groups);
  rest_angles8_.resize(groups);
  corner_forces_.resize(4 * kLanes * static_cast<std::size_t>(groups));
  corner_slopes_.resize(corner_forces_.size());
  for (int g = 0; g < groups; ++g) {
    for (int a = 0; a < 4; ++a) {
      for (int l = 0; l < kLanes; ++l)
        corners8_.push_back(vertices(std::min(kLanes * g + l, element_count() - 1))[a]);
    }
  }
  std::vector<std::pair<int, int>> of_vertices;
  for (int h = 0; h < element_count(); ++h) {
    for (int a = 0; a < 4; ++a) of_vertices.emplace_back(vertices(h)[a], 4 * h + a);
  }
  vertex_corners_ = IndexLists(vertex_count, of_vertices);
}

void Hinges::bind(const BlockPattern& pattern) {
  std::vector<std::pair<int, int>> of_slots;
  for (int h = 0; h < element_count(); ++h) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b)
        of_slots.emplace_back(pattern.slot(vertices(h)[a], vertices(h)[b]), 16 * h + 4 * a + b);
    }
  }
  slot_corners_ = IndexLists(pattern.slot_count(), of_slots);
}

void Hinges::set_rest_angles(const Eigen::VectorXd& angles) {
  detail::require_count("rest angles", angles.size(), element_count());
  detail::require_finite("the rest angle of hinge", angles);
  rest_angles_ = angles;
  for (int h = 0; h < element_count(); ++h) rest_angles8_[h / kLanes].lanes[h % kLanes] = angles[h];
}

void Hinges::set_stiffness(const Eigen::VectorXd& stiffness) {
  detail::require_count("stiffnesses", stiffness.size(), element_count());
  detail::require_values("the stiffness of hinge", stiffness, 0.0, false);
  stiffness_ = stiffness;
  for (int h = 0; h < element_count(); ++h)
    moduli8_[h / kLanes].lanes[h % kLanes] = stiffness[h] * weights_[h];
}

Eigen::VectorXd Hinges::angles(const Points3& x) const {
  Eigen::VectorXd angles(kLanes * group_count());
  parallel_for(group_count(), kGroups, [&](int begin, int end) {
    angles_of_groups({x.data(), corners8_.data(), nullptr, nullptr}, begin, end, angles.data());
  });
  return angles.head(element_count());
}

double Hinges::energy(const Points3& x) const {
  return parallel_sum(group_count(), kGroups, [&](int begin, int end) {
    return energy_of_groups({x.data(), corners8_.data(), moduli8_.data(), rest_angles8_.data()}, begin, end);
  });
}

void Hinges::add_gradient(const Points3& x, Points3& gradient) const {
  parallel_for(group_count(), kGroups, [&](int begin, int end) {
    gradients_of_groups({x.data(), corners8_.data(), moduli8_.data(), rest_angles8_.data()}, begin, end,
                        corner_forces_.data());
  });
  parallel_for(static_cast<int>(x.rows()), kVertices, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Double4 sum{};
      for (const int corner : vertex_corners_[i]) sum += corner_forces_[corner].xyz;
      for (int k = 0; k < 3; ++k) gradient(i, k) += sum[k];
    }
  });
}

void Hinges::add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature) const {
  parallel_for(group_count(), kGroups, [&](int begin, int end) {
    slopes_of_groups({x.data(), corners8_.data(), moduli8_.data(), nullptr}, scale, begin, end,
                     corner_slopes_.data());
  });
  parallel_for(matrix.pattern().slot_count(), kSlots, [&](int begin, int end) {
    add_outer_products(slot_corners_, corner_slopes_.data(), begin, end, matrix.values());
  });
}

}  // namespace wilt
