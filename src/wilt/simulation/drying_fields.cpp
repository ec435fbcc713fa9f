// Symbols: L leaf length, l_w wrinkle length / L, gd distance to the nearest primary vein, d_v to the nearest
// vein of any order, d_m to the margin, d_t to the nearest tip (d's / L), g the gradient of one of them, xi
// smooth noise.
#include "wilt/simulation/drying_fields.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/margin_distance.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/simulation/smooth_noise.hpp"

namespace wilt {
namespace {

using Eigen::Matrix3d;
using Eigen::VectorXd;
using Tensors = std::vector<Matrix3d>;

constexpr double kVeinReach = 0.05;   // distance over which the lamina loses touch with its vein, / L
constexpr double kMarginPower = 1.5;  // how late towards the margin the shrinking sets in
constexpr double kFoldNoise = 0.5;    // how unevenly the lamina folds
constexpr double kFineNoise = 0.4;    // wavelength of the rim's crinkles, / l_w

double metres_per_length(const ModelInput& input) {
  return kWorkingLength / input.scale;
}

VectorXd noise(const ModelInput& input, double wavelength, const char* purpose) {
  return smooth_noise(input.leaf.positions.leftCols<2>() / metres_per_length(input), wavelength,
                      static_cast<std::uint64_t>(input.config.seed), purpose);
}

// g g^T at every vertex, g the unit gradient of a distance: the line along which it grows. Where the lines of
// the faces around a vertex differ (on a vein's end, midway between two veins), the tensor is their mean.
Tensors gradient_lines(const ModelInput& input, const VectorXd& distance) {
  const SurfaceMesh& mesh = input.leaf.mesh;
  const Points3& x = input.leaf.positions;
  Tensors lines(mesh.num_vertices(), Matrix3d::Zero());
  VectorXd weights = VectorXd::Zero(mesh.num_vertices());
  for (const FaceId f : mesh.faces()) {
    const auto v = mesh.face_vertices(f);
    const auto side = [&](int k) {
      return Vec3((x.row(v[(k + 2) % 3]) - x.row(v[(k + 1) % 3])).transpose());
    };
    const Vec3 normal = side(2).cross(-side(1));
    Vec3 gradient = Vec3::Zero();
    for (int k = 0; k < 3; ++k) gradient += distance[v[k]] * normal.cross(side(k));
    if (gradient.isZero(0.0)) continue;
    gradient.normalize();
    for (const VertexId corner : v) {
      lines[corner] += normal.norm() * gradient * gradient.transpose();
      weights[corner] += normal.norm();
    }
  }
  for (const VertexId v : mesh.vertices()) {
    if (weights[v] > 0.0) lines[v] /= weights[v];
  }
  return lines;
}

// 1 at distance 0, falling to 1/e at `reach`.
VectorXd within(const VectorXd& distance, double reach) {
  return (-(distance / reach).array().square()).exp();
}

// Ridge on the vein (-1), furrow in the middle of a panel (1), nothing far from any vein; s in half panels.
double panel_profile(double s) {
  const double wave = std::cos(std::numbers::pi * std::min(s, 2.0));
  return s < 1.0 ? -wave : 0.5 * (1.0 - wave);
}

VectorXd differential_strain(const ModelInput& input, const VectorXd& vein_distance) {
  const auto& c = input.config.shrinkage;
  const VectorXd& gd = input.venation.primary_distance;
  const VectorXd xi = noise(input, wrinkle_length(input), "differential strain");
  VectorXd eta(gd.size());
  for (int i = 0; i < eta.size(); ++i) {
    const double gap = std::clamp(vein_distance[i] / kVeinReach, 0.0, 1.0);
    eta[i] = c.amount * (-c.vein_gap * gap * gap - c.margin * std::pow(gd[i] / gd.maxCoeff(), kMarginPower) +
                         c.noise * xi[i]);
  }
  return eta;
}

}  // namespace

double wrinkle_length(const ModelInput& input) {
  const double area = surface_area(input.leaf.mesh, input.rest) / (kWorkingLength * kWorkingLength);
  return input.config.bending.wrinkle_length * std::sqrt(area);
}

DryingFields drying_fields(const ModelInput& input) {
  const auto& c = input.config.curvature;
  const auto& bending = input.config.bending;
  const auto& shrinkage = input.config.shrinkage;
  const double length = metres_per_length(input), l_w = wrinkle_length(input);
  const VectorXd d_m = margin_distance(input.leaf) / length, d_v = input.venation.vein_distance / length,
                 d_t = input.venation.tip_distance.colwise().minCoeff().transpose() / length;
  const Tensors from_margin = gradient_lines(input, d_m), from_tip = gradient_lines(input, d_t),
                from_vein = gradient_lines(input, d_v);
  const VectorXd rim = within(d_m, c.roll_reach), end = within(d_t, c.tip_reach);
  const VectorXd uneven = noise(input, 2.0 * l_w, "curvature"), coarse = noise(input, l_w, "folds"),
                 fine = noise(input, kFineNoise * l_w, "crinkles");

  const std::size_t n = from_margin.size();
  DryingFields fields{differential_strain(input, d_v), Tensors(n), Tensors(n), Tensors(n)};
  for (int i = 0; i < d_m.size(); ++i) {
    const Matrix3d along_vein = Matrix3d::Identity() - from_vein[i];
    const Matrix3d along_margin = Matrix3d::Identity() - from_margin[i];
    fields.folds[i] = shrinkage.amount * (shrinkage.fold * (1.0 + kFoldNoise * coarse[i]) * from_vein[i] +
                                          shrinkage.crinkle * rim[i] * (1.0 + fine[i]) * along_margin);
    fields.grain[i] = bending.grain * (1.0 - rim[i]) * along_vein +
                      (bending.rim_factor - 1.0) * (rim[i] * from_margin[i] + end[i] * from_tip[i]);
    const double share = 1.0 + c.variation * uneven[i];
    const double furrow = (1.0 - rim[i]) * (1.0 - end[i]) * panel_profile(2.0 * d_v[i] / l_w);
    fields.curvature[i] = (c.roll * share * rim[i] * from_margin[i] + c.tip * end[i] * from_tip[i] +
                           c.panel * share * furrow * from_vein[i]) /
                          kWorkingLength;
  }
  return fields;
}

}  // namespace wilt
