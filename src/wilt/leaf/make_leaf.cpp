// Relief of a fresh leaf, in units of its length, y along the midrib, d the distance to the nearest main
// vein:
//   z = v tanh(d / w)                   veins lie in valleys
//     + f (sqrt(x^2 + e^2) - e)         the two halves fold up along the midrib
//     + a y - b y^2 - c x^2             an arch along the blade, a dome across it
//     + sum_k A_k sin(q_k . (x, y) + phi_k), growing from the petiole outwards
// The coefficients are ours, chosen for slopes below about 0.4.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wilt/core/random.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

class Relief {
 public:
  Relief(const BladeOutline& blade, std::uint64_t seed) : tips_(blade.tips) {
    Random random(seed, "leaf relief");
    valley_ = 0.030 * random.uniform(0.8, 1.2);
    fold_ = 0.10 * random.uniform(0.5, 1.5);
    arch_ = 0.07 * random.uniform(0.4, 1.4);
    droop_ = 0.11 * random.uniform(0.4, 1.4);
    dome_ = 0.10 * random.uniform(-0.3, 1.3);
    for (Wave& wave : waves_) {
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double length = random.uniform(0.28, 0.7);
      wave.vector = 2.0 * std::numbers::pi / length * Vec2(std::cos(angle), std::sin(angle));
      wave.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      wave.amplitude = 0.012 * length * random.normal();
    }
  }

  double operator()(const Vec2& p) const {
    constexpr double kValleyWidth = 0.13;
    constexpr double kCrease = 0.015;
    const double x = p.x(), y = p.y();
    double z = valley_ * std::tanh(vein_distance(p) / kValleyWidth);
    z += fold_ * (std::sqrt(x * x + kCrease * kCrease) - kCrease);
    z += arch_ * y - droop_ * y * y - dome_ * x * x;
    const double outwards = std::min(1.0, p.squaredNorm() / 0.09);
    for (const Wave& wave : waves_)
      z += outwards * wave.amplitude * std::sin(wave.vector.dot(p) + wave.phase);
    return z;
  }

 private:
  struct Wave {
    Vec2 vector = Vec2::Zero();
    double phase = 0.0, amplitude = 0.0;
  };

  // The distance to the nearest main vein, smooth between veins: (sum d_i^-4)^(-1/4).
  double vein_distance(const Vec2& p) const {
    constexpr double kCrease = 0.012;
    double sum = 0.0;
    for (const Vec2& tip : tips_) {
      const double t = std::clamp(p.dot(tip) / tip.squaredNorm(), 0.0, 1.0);
      const double d = std::sqrt((p - t * tip).squaredNorm() + kCrease * kCrease);
      sum += 1.0 / (d * d * d * d);
    }
    return std::pow(sum, -0.25);
  }

  std::vector<Vec2> tips_;
  double valley_ = 0.0, fold_ = 0.0, arch_ = 0.0, droop_ = 0.0, dome_ = 0.0;
  std::array<Wave, 7> waves_;
};

// A stalk that leaves the blade towards -y, bends, and thickens where it joined the twig.
Stalk make_stalk(const Species& species, std::uint64_t seed) {
  constexpr int kPoints = 24;
  Random random(seed, "leaf stalk");
  const double length = species.length * species.stalk_length * random.uniform(0.85, 1.15);
  const double radius = species.length * species.stalk_radius;
  const double pitch_start = -0.25, pitch_turn = random.uniform(-0.5, 0.9);  // radians, positive is up
  const double yaw_turn = 0.35 * random.normal();
  Stalk stalk;
  stalk.centreline.resize(kPoints, 3);
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < kPoints; ++k) {
    const double t = double(k) / (kPoints - 1);
    stalk.centreline.row(k) = p.transpose();
    stalk.radii.push_back(radius * (0.85 + 0.1 * t + 0.55 * std::pow(t, 8)));
    const double pitch = pitch_start + pitch_turn * t, yaw = yaw_turn * t;
    p += length / (kPoints - 1) *
         Vec3(std::cos(pitch) * std::sin(yaw), -std::cos(pitch) * std::cos(yaw), std::sin(pitch));
  }
  return stalk;
}

}  // namespace

Leaf make_leaf(std::string_view species_name, int vertices, std::uint64_t seed, const Monitor& monitor) {
  constexpr double kReliefReserve = 0.03;  // radians that the relief may take from an angle
  const Species& kind = species(species_name);
  const BladeOutline blade = blade_outline(species_name, seed);
  MeshingOptions options;
  options.vertices = vertices;
  options.smallest_angle += kReliefReserve;
  options.keep = {blade.petiole};
  options.keep.insert(options.keep.end(), blade.tips.begin(), blade.tips.end());
  PlanarMesh planar = mesh_outline(blade.outline, options, monitor);

  Leaf leaf;
  leaf.name = kind.name;
  leaf.species = kind.name;
  leaf.seed = seed;
  leaf.petiole = planar.kept.front();
  const Relief relief(blade, seed);
  const Vec2 base = planar.positions.row(leaf.petiole).transpose();
  leaf.positions.resize(planar.positions.rows(), 3);
  for (Eigen::Index i = 0; i < planar.positions.rows(); ++i) {
    const Vec2 p = planar.positions.row(i).transpose();
    leaf.positions.row(i) << p.x() - base.x(), p.y() - base.y(), relief(p) - relief(base);
  }
  leaf.mesh = std::move(planar.mesh);
  leaf.positions *= kind.length / leaf_length(leaf);
  leaf.stalk = make_stalk(kind, seed);
  leaf.skin = planar_skin(leaf.mesh, leaf.positions);
  return leaf;
}

}  // namespace wilt
