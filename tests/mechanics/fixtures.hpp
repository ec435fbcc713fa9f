// Surfaces and ready-made systems for the tests of mechanics.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "wilt/core/random.hpp"
#include "wilt/mechanics/area_limit.hpp"
#include "wilt/mechanics/edge_energies.hpp"
#include "wilt/mechanics/edge_forces.hpp"
#include "wilt/mechanics/hinges.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"
#include "wilt/mechanics/nodal_terms.hpp"
#include "wilt/mechanics/system.hpp"

namespace wilt::test {

struct Sheet {
  Points3 positions;
  Faces faces;
  Edges edges;
};

inline Edges edges_of(const Faces& faces) {
  std::set<std::pair<int, int>> pairs;
  for (int f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) pairs.insert(std::minmax(faces(f, k), faces(f, (k + 1) % 3)));
  }
  Edges edges(static_cast<int>(pairs.size()), 2);
  int e = 0;
  for (const auto& [i, j] : pairs) edges.row(e++) << i, j;
  return edges;
}

/// A square of side `side` in cells x cells squares, each cut by a diagonal; interior vertices moved at
/// random in the plane by up to a fifth of a cell, and every vertex out of it by up to `relief` of a cell.
inline Sheet sheet(int cells, double side, double relief, std::uint64_t seed) {
  Sheet result;
  Random random(seed, "sheet");
  result.positions.resize((cells + 1) * (cells + 1), 3);
  result.faces.resize(2 * cells * cells, 3);
  const double h = side / cells;
  int f = 0;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const int v = j * (cells + 1) + i;
      const double dx = random.uniform(-0.2, 0.2), dy = random.uniform(-0.2, 0.2),
                   dz = random.uniform(-1.0, 1.0);
      const bool inside = i > 0 && j > 0 && i < cells && j < cells;
      result.positions.row(v) << h * (i + (inside ? dx : 0.0)), h * (j + (inside ? dy : 0.0)),
          h * relief * dz;
      if (i == cells || j == cells) continue;
      const int right = v + 1, up = v + cells + 1;
      result.faces.row(f++) << v, right, up + 1;
      result.faces.row(f++) << v, up + 1, up;
    }
  }
  result.edges = edges_of(result.faces);
  return result;
}

inline Eigen::VectorXd lengths(const Edges& edges, const Points3& x) {
  Eigen::VectorXd lengths(edges.rows());
  for (int e = 0; e < edges.rows(); ++e) lengths[e] = (x.row(edges(e, 1)) - x.row(edges(e, 0))).norm();
  return lengths;
}

inline Points3 random_points(int count, double size, Random& random) {
  Points3 points(count, 3);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) points(i, k) = random.uniform(-size, size);
  }
  return points;
}

inline Eigen::VectorXd random_values(int count, double low, double high, Random& random) {
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) values[i] = random.uniform(low, high);
  return values;
}

/// A blade like the default model's: springs, strain and area limits, hinges, line tension, damping, a force
/// that curls one corner; the opposite corner is held. Masses scale as the simulation's, total 120.
struct Blade {
  Sheet shape;
  std::unique_ptr<System> system;
  Springs* springs = nullptr;
  Hinges* hinges = nullptr;
  NodalForce* load = nullptr;
  MotionState state;
};

inline Blade blade(int cells, double damping = 0.1) {
  Blade blade;
  blade.shape = sheet(cells, 8.0, 0.05, 1);
  const Points3& x = blade.shape.positions;
  const Edges& edges = blade.shape.edges;
  const int n = static_cast<int>(x.rows()), e = static_cast<int>(edges.rows());
  std::vector<char> pinned(n, 0);
  for (int i = 0; i < n; ++i) pinned[i] = x.row(i).head<2>().norm() < 0.5;
  const Eigen::VectorXd rest = lengths(edges, x);
  blade.system = std::make_unique<System>(Eigen::VectorXd::Constant(n, 120.0 / n), pinned);
  blade.springs = &blade.system->add_energy(
      "elastic", std::make_unique<Springs>(edges, rest, Eigen::VectorXd::Constant(e, 4.0)));
  blade.system->add_energy(
      "limit", std::make_unique<StrainLimit>(edges, rest, Eigen::VectorXd::Constant(e, 100.0), 0.2));
  blade.system->add_energy(
      "area", std::make_unique<AreaLimit>(blade.shape.faces, x,
                                          Eigen::VectorXd::Constant(blade.shape.faces.rows(), 1.0), 0.4));
  const Stencil stencil = hinge_stencil(blade.shape.faces);
  blade.hinges = &blade.system->add_energy(
      "bending", std::make_unique<Hinges>(stencil, x, Eigen::VectorXd::Constant(stencil.rows(), 2.5e-3)));
  Eigen::VectorXd tension(e);
  for (int k = 0; k < e; ++k) tension[k] = 0.3 * std::sin(1.7 * x(edges(k, 0), 0)) * rest[k];
  blade.system->add_energy("swelling", std::make_unique<LineTension>(edges, tension));
  blade.system->add_force("damping",
                          std::make_unique<EdgeDamping>(edges, Eigen::VectorXd::Constant(e, damping)));
  Points3 load = Points3::Zero(n, 3);
  for (int i = 0; i < n; ++i)
    load(i, 2) = 4.8 / n * std::exp(-(x.row(i).head<2>() - Eigen::RowVector2d(8, 8)).norm());
  blade.load = &blade.system->add_force("external", std::make_unique<NodalForce>(load));
  blade.state.positions = x;
  return blade;
}

}  // namespace wilt::test
