#include "bench/workload.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wilt/core/random.hpp"

namespace wilt::bench {
namespace {

constexpr double kJitter = 0.12;      // of the lattice's spacing
constexpr double kPetioleEnd = 0.03;  // vertices below this x are held
constexpr double kShrinkage = 0.1;    // the largest share of a rest length that goes
constexpr double kDriveSteps = 100.0;

// y at the margin, for x in (0, 1); negative outside.
double half_width(double x) {
  return x > 0.0 && x < 1.0 ? 0.25 * std::sin(std::numbers::pi * std::pow(x, 0.85)) : -1.0;
}

double height(double x, double y) {
  return 0.35 * y * y + 0.08 * std::sin(std::numbers::pi * x) + 0.01 * std::sin(9.0 * x) * std::sin(14.0 * y);
}

double blade_area() {
  constexpr int kSlices = 10000;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) sum += 2.0 * half_width((i + 0.5) / kSlices) / kSlices;
  return sum;
}

// Rows of a hexagonal lattice across the blade; a point outside of it has the number -1.
class Lattice {
 public:
  explicit Lattice(double spacing)
      : spacing_(spacing), half_(static_cast<int>(0.26 / spacing) + 3), random_(1, "workload") {
    const double pitch = spacing * std::sqrt(3.0) / 2.0;
    for (int i = 0; (i + 0.5) * pitch < 1.0; ++i) add_row(i, (i + 0.5) * pitch);
  }

  // Two triangles to each cell between neighbouring rows, where all corners are there.
  std::vector<std::array<int, 3>> triangles() const {
    std::vector<std::array<int, 3>> result;
    const auto add = [&](int a, int b, int c) {
      if (a >= 0 && b >= 0 && c >= 0) result.push_back({a, b, c});
    };
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
      const std::vector<int>&lower = rows_[i], &upper = rows_[i + 1];
      for (std::size_t j = 0; j + 1 < lower.size(); ++j) {
        const bool shifted = i % 2 == 1;  // rows of odd number lie half a spacing further
        add(lower[j], upper[shifted ? j + 1 : j], lower[j + 1]);
        add(upper[j], upper[j + 1], lower[shifted ? j : j + 1]);
      }
    }
    return result;
  }

  const std::vector<Vec3>& points() const { return points_; }

 private:
  void add_row(int i, double x) {
    std::vector<int>& row = rows_.emplace_back();
    for (int j = -half_; j <= half_; ++j) {
      const double y = (j + 0.5 * (i % 2)) * spacing_;
      row.push_back(std::abs(y) <= half_width(x) ? static_cast<int>(points_.size()) : -1);
      if (row.back() < 0) continue;
      const double moved_x = x + random_.uniform(-kJitter, kJitter) * spacing_;
      const double moved_y = y + random_.uniform(-kJitter, kJitter) * spacing_;
      points_.emplace_back(moved_x, moved_y, height(moved_x, moved_y));
    }
  }

  double spacing_;
  int half_;
  Random random_;
  std::vector<std::vector<int>> rows_;
  std::vector<Vec3> points_;
};

// Numbers the vertices that a triangle uses anew, in their old order.
Surface without_loose_points(const std::vector<Vec3>& points,
                             const std::vector<std::array<int, 3>>& triangles) {
  std::vector<int> number(points.size(), -1);
  for (const auto& triangle : triangles) {
    for (const int v : triangle) number[static_cast<std::size_t>(v)] = 0;
  }
  Surface surface;
  surface.positions.resize(static_cast<int>(points.size()), 3);
  int count = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (number[v] < 0) continue;
    surface.positions.row(count) = points[v].transpose();
    number[v] = count++;
  }
  surface.positions.conservativeResize(count, 3);
  Faces faces(static_cast<int>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int c = 0; c < 3; ++c)
      faces(static_cast<int>(f), c) = number[static_cast<std::size_t>(triangles[f][c])];
  }
  surface.mesh = SurfaceMesh(count, faces);
  return surface;
}

Edges sorted_edges(const SurfaceMesh& mesh) {
  const Edges edges = mesh.edge_matrix();
  std::vector<std::array<int, 2>> rows(static_cast<std::size_t>(edges.rows()));
  for (int e = 0; e < edges.rows(); ++e)
    rows[static_cast<std::size_t>(e)] = {std::min(edges(e, 0), edges(e, 1)),
                                         std::max(edges(e, 0), edges(e, 1))};
  std::sort(rows.begin(), rows.end());
  Edges sorted(edges.rows(), 2);
  for (int e = 0; e < edges.rows(); ++e)
    sorted.row(e) << rows[static_cast<std::size_t>(e)][0], rows[static_cast<std::size_t>(e)][1];
  return sorted;
}

}  // namespace

Surface leaf_surface(int vertices) {
  // A point of the lattice stands for spacing^2 sqrt(3)/2.
  const Lattice lattice(std::sqrt(blade_area() / vertices * 2.0 / std::sqrt(3.0)));
  return without_loose_points(lattice.points(), lattice.triangles());
}

SpringProblem spring_problem(int vertices, double stiffness) {
  Surface surface = leaf_surface(vertices);
  const Points3& x = surface.positions;
  SpringProblem problem{surface.mesh, x, sorted_edges(surface.mesh), {}, {}, {}, {}, stiffness};
  problem.masses.resize(x.rows());
  problem.pinned.resize(static_cast<std::size_t>(x.rows()));
  for (int i = 0; i < x.rows(); ++i) {
    problem.masses[i] = 1.1 + 0.4 * std::sin(5.0 * x(i, 0) + 11.0 * x(i, 1));
    problem.pinned[static_cast<std::size_t>(i)] = x(i, 0) < kPetioleEnd;
  }
  problem.first_rest.resize(problem.edges.rows());
  problem.shrinkage.resize(problem.edges.rows());
  for (int e = 0; e < problem.edges.rows(); ++e) {
    const auto a = x.row(problem.edges(e, 0)), b = x.row(problem.edges(e, 1));
    problem.first_rest[e] = (b - a).norm();
    problem.shrinkage[e] = kShrinkage * (0.5 + 0.5 * std::sin(7.0 * a[0]) * std::cos(9.0 * a[1]));
  }
  return problem;
}

Eigen::VectorXd SpringProblem::rest_lengths(int step) const {
  const double progress = std::min(1.0, (step + 1) / kDriveSteps);
  return first_rest.array() * (1.0 - progress * shrinkage.array());
}

int timed_steps(int vertices) {
  return vertices > 500000 ? 4 : vertices > 50000 ? 8 : vertices > 5000 ? 20 : 100;
}

std::vector<VertexId> spread_sources(const SurfaceMesh& mesh, int count) {
  std::vector<VertexId> sources;
  const auto last = static_cast<std::int64_t>(mesh.num_vertices() - 1);
  for (int k = 0; k < count; ++k)
    sources.emplace_back(static_cast<int>(count == 1 ? 0 : k * last / (count - 1)));
  return sources;
}

}  // namespace wilt::bench
