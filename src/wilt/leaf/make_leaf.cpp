#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wilt/core/random.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/relief.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

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
  const Relief relief(blade.tips, seed);
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
