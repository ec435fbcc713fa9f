// Small surfaces with known geometry, for tests.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "wilt/core/random.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt::test {

struct Surface {
  SurfaceMesh mesh;
  Points3 positions;
};

/// A rectangle [0, width] x [0, height] of columns x rows cells, each cut along a diagonal that alternates.
inline Surface grid(int columns, int rows, double width = 1.0, double height = 1.0) {
  Points3 positions((columns + 1) * (rows + 1), 3);
  Faces faces(2 * columns * rows, 3);
  const auto at = [&](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) positions.row(at(i, j)) << width * i / columns, height * j / rows, 0.0;
  }
  int f = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if ((i + j) % 2 == 0) {
        faces.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
        faces.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
      } else {
        faces.row(f++) << at(i, j), at(i + 1, j), at(i, j + 1);
        faces.row(f++) << at(i + 1, j), at(i + 1, j + 1), at(i, j + 1);
      }
    }
  }
  return {SurfaceMesh(static_cast<int>(positions.rows()), faces), positions};
}

/// The same surface bent: every vertex moved by `move`.
inline Surface bent(Surface surface, const std::function<Vec3(const Vec3&)>& move) {
  for (int v = 0; v < surface.positions.rows(); ++v)
    surface.positions.row(v) = move(surface.positions.row(v).transpose()).transpose();
  return surface;
}

/// Interior vertices of a flat grid moved sideways at random by up to `amount` of a cell.
inline Surface jittered_grid(int cells, double amount, std::uint64_t seed) {
  Surface surface = grid(cells, cells);
  Random random(seed, "jittered_grid");
  for (const VertexId v : surface.mesh.vertices()) {
    const double dx = random.uniform(-amount, amount) / cells, dy = random.uniform(-amount, amount) / cells;
    if (!surface.mesh.is_boundary(v)) surface.positions.row(v) += Vec3(dx, dy, 0.0).transpose();
  }
  return surface;
}

}  // namespace wilt::test
