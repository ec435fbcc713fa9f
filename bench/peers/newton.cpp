#include "bench/peers/newton.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace wilt::bench {

MidpointEquation::MidpointEquation(const SpringProblem& problem)
    : problem_(problem), rest_(problem.first_rest) {
  make_pattern();
}

void MidpointEquation::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, i == j && r == c ? 1.0 : 0.0);
    }
  };
  const Edges& edges = problem_.edges;
  for (int i = 0; i < problem_.vertex_count(); ++i) add(i, i);
  for (int e = 0; e < edges.rows(); ++e) {
    add(edges(e, 0), edges(e, 1));
    add(edges(e, 1), edges(e, 0));
  }
  matrix_.resize(3 * problem_.vertex_count(), 3 * problem_.vertex_count());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  const auto slot = [&](int row, int column) {
    const int* rows = matrix_.innerIndexPtr();
    return static_cast<int>(std::lower_bound(rows + matrix_.outerIndexPtr()[column],
                                             rows + matrix_.outerIndexPtr()[column + 1], row) -
                            rows);
  };
  slots_.resize(static_cast<std::size_t>(edges.rows()));
  for (int e = 0; e < edges.rows(); ++e) {
    for (int k = 0; k < 12; ++k)
      slots_[static_cast<std::size_t>(e)][static_cast<std::size_t>(k)] =
          slot(3 * edges(e, k / 6), 3 * edges(e, k / 3 % 2) + k % 3);
  }
}

void MidpointEquation::add_block(int e, int a, int b, const Eigen::Matrix3d& block) {
  for (int c = 0; c < 3; ++c) {
    const int first = slots_[static_cast<std::size_t>(e)][static_cast<std::size_t>(6 * a + 3 * b + c)];
    for (int r = 0; r < 3; ++r) matrix_.valuePtr()[first + r] += block(r, c);
  }
}

void MidpointEquation::add_spring(int e, const Eigen::VectorXd& x, const Eigen::VectorXd& v) {
  const double dt = problem_.dt, k = problem_.stiffness;
  const int i = problem_.edges(e, 0), j = problem_.edges(e, 1);
  const Vec3 d = x.segment<3>(3 * j) - x.segment<3>(3 * i);
  const double length = d.norm();
  const Vec3 force =
      k * (length - rest_[e]) / length * d + problem_.damping * (v.segment<3>(3 * j) - v.segment<3>(3 * i));
  residual_.segment<3>(3 * i) += dt * force;
  residual_.segment<3>(3 * j) -= dt * force;
  const double pull = k * std::max(0.0, 1.0 - rest_[e] / length);
  Eigen::Matrix3d block = 0.25 * dt * dt * (k - pull) / (length * length) * d * d.transpose();
  block.diagonal().array() += 0.25 * dt * dt * pull + 0.5 * dt * problem_.damping;
  const bool free_i = !problem_.pinned[static_cast<std::size_t>(i)];
  const bool free_j = !problem_.pinned[static_cast<std::size_t>(j)];
  if (free_i) add_block(e, 0, 0, block);
  if (free_j) add_block(e, 1, 1, block);
  if (free_i && free_j) {
    add_block(e, 0, 1, -block);
    add_block(e, 1, 0, -block);
  }
}

void MidpointEquation::evaluate(const Eigen::VectorXd& x0, const Eigen::VectorXd& v0,
                                const Eigen::VectorXd& v1) {
  const Eigen::VectorXd v = 0.5 * (v0 + v1), x = x0 + 0.5 * problem_.dt * v;
  residual_.setZero(x0.size());
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (int e = 0; e < problem_.edge_count(); ++e) add_spring(e, x, v);
  for (int i = 0; i < problem_.vertex_count(); ++i) {
    const double m = problem_.masses[i];
    for (int c = 3 * i; c < 3 * i + 3; ++c) matrix_.coeffRef(c, c) += m;
    if (problem_.pinned[static_cast<std::size_t>(i)]) {
      residual_.segment<3>(3 * i).setZero();
    } else {
      residual_.segment<3>(3 * i) -= m * (v1 - v0).segment<3>(3 * i);
      residual_[3 * i + 2] -= problem_.dt * m * problem_.gravity;
    }
  }
}

}  // namespace wilt::bench
