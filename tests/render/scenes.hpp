// Plain scenes whose pictures are known.
#pragma once

#include <cmath>
#include <numbers>

#include "support/meshes.hpp"
#include "wilt/render/picture.hpp"

namespace wilt::test {

/// No coat: what a formula can say.
inline Finish matt(double translucency = 0.0) {
  return {translucency, 0.0, 0.4};
}

inline wilt::Surface drawn(Points3 positions, Faces faces, const Vec3& colour, bool leaf) {
  wilt::Surface surface;
  surface.colours = colour.transpose().replicate(positions.rows(), 1);
  surface.positions = std::move(positions);
  surface.faces = std::move(faces);
  surface.leaf = leaf;
  surface.finish = matt();
  return surface;
}

/// A square of side 2 `half` about the origin at height z, facing up.
inline wilt::Surface square(double half, double z, const Vec3& colour, bool leaf) {
  Points3 positions(4, 3);
  positions << -half, -half, z, half, -half, z, half, half, z, -half, half, z;
  Faces faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  return drawn(positions, faces, colour, leaf);
}

/// A bowl or a dome: a grid of `cells` squared over [-1, 1]^2 lifted to z = height (x^2 + y^2).
inline wilt::Surface paraboloid(int cells, double height, const Vec3& colour, bool leaf) {
  const test::Surface flat = grid(cells, cells, 2.0, 2.0);
  Points3 positions = flat.positions;
  positions.leftCols(2).array() -= 1.0;
  positions.col(2) = height * positions.leftCols(2).rowwise().squaredNorm();
  Faces faces(2 * cells * cells, 3);
  for (int j = 0, f = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + cells + 1;
      faces.row(f++) << a, a + 1, b + 1;
      faces.row(f++) << a, b + 1, b;
    }
  }
  return drawn(positions, faces, colour, leaf);
}

/// A sphere of radius 1 about the origin.
inline wilt::Surface sphere(int rings, const Vec3& colour) {
  const int around = 2 * rings;
  Points3 positions((rings + 1) * around, 3);
  Faces faces(2 * rings * around, 3);
  for (int i = 0, f = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double a = 2.0 * std::numbers::pi * j / around;
      positions.row(i * around + j) << std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a),
          std::cos(polar);
      if (i == rings) continue;
      const int k = i * around + j, next = i * around + (j + 1) % around;
      faces.row(f++) << k, k + around, next + around;
      faces.row(f++) << k, next + around, next;
    }
  }
  return drawn(positions, faces, colour, false);
}

inline Sky uniform_sky(const Vec3& radiance) {
  return {radiance, radiance, radiance};
}

/// Small, without ground, light or background; the camera looks down from above at [-1, 1]^2.
inline PictureOptions dark_studio(int size = 16) {
  PictureOptions options;
  options.width = options.height = size;
  options.samples = 4;
  options.ground = false;
  options.background = Vec3::Zero();
  options.lighting.sky = uniform_sky(Vec3::Zero());
  options.lighting.sun.irradiance = Vec3::Zero();
  options.lighting.sun.direction = Vec3::UnitZ();
  options.camera = Camera{{0.0, 0.0, 20.0}, {0.0, 0.0, -1.0}, Vec3::UnitY(), 2.0 * std::atan(1.0 / 20.0)};
  return options;
}

inline Vec3 at(const Radiance& picture, int x, int y) {
  return picture.rgb.row(Eigen::Index(y) * picture.width + x).transpose();
}

inline Vec3 centre(const Radiance& picture) {
  return at(picture, picture.width / 2, picture.height / 2);
}

}  // namespace wilt::test
