// What one would write with a sparse library at hand: implicit midpoint by Newton's method to 1e-8 on an
// assembled matrix of a fixed pattern. The printed equations, as wilt solves them, so that results agree to
// the tolerance.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "bench/scenario.hpp"
#include "bench/stopwatch.hpp"

namespace wilt::bench {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Residual and matrix of one step; the unknowns are the velocities at its end, 3 #V, vertex by vertex.
class MidpointEquation {
 public:
  explicit MidpointEquation(const SpringProblem& problem);

  void set_rest_lengths(const Eigen::VectorXd& lengths) { rest_ = lengths; }

  /// From positions x0 and velocities v0 to velocities v1.
  void evaluate(const Eigen::VectorXd& x0, const Eigen::VectorXd& v0, const Eigen::VectorXd& v1);

  /// dt F - M (v1 - v0), 0 on held vertices.
  const Eigen::VectorXd& residual() const { return residual_; }
  /// M - dt^2/4 dF/dx - dt/2 dF/dv, made semi-definite where a spring is compressed.
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  void make_pattern();
  void add_spring(int e, const Eigen::VectorXd& x, const Eigen::VectorXd& v);
  void add_block(int e, int a, int b, const Eigen::Matrix3d& block);

  const SpringProblem& problem_;
  Eigen::VectorXd rest_, residual_;
  SparseMatrix matrix_;
  std::vector<std::array<int, 12>> slots_;  // of an edge: where the columns of its four blocks begin
};

/// Steps the workload. `Solver` is made of the matrix's pattern and has solve(matrix, right side).
template <class Solver>
void newton_step(benchmark::State& state, int vertices, double stiffness) {
  constexpr double kTolerance = 1e-8;  // of a step's first residual
  constexpr int kMaxNewton = 12;
  const SpringProblem problem = spring_problem(vertices, stiffness);
  MidpointEquation equation(problem);
  Eigen::VectorXd x = problem.positions.reshaped<Eigen::RowMajor>(), v = Eigen::VectorXd::Zero(x.size());
  Solver solver(equation.matrix());
  StepTimes times(state, problem);
  int step = 0, newton = 0;
  for (auto _ : state) {
    equation.set_rest_lengths(problem.rest_lengths(step++));
    const Stopwatch watch;
    Eigen::VectorXd after = v;
    equation.evaluate(x, v, after);
    const double wanted = kTolerance * equation.residual().norm();
    for (int k = 0; k < kMaxNewton && equation.residual().norm() > wanted; ++k, ++newton) {
      after += solver.solve(equation.matrix(), equation.residual());
      equation.evaluate(x, v, after);
    }
    x += 0.5 * problem.dt * (v + after);
    v = after;
    times.add(watch.seconds());
  }
  times.report(x.reshaped<Eigen::RowMajor>(problem.vertex_count(), 3));
  state.counters["newton"] = static_cast<double>(newton) / step;
}

}  // namespace wilt::bench
