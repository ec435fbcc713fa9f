// Symbols (paper, section 4.3): w water, b dry mass, m = w + b, l_ij rest length, lambda diffusion
// coefficient, E the normalising length, u = w/b, g_ij the conductance of edge ij, L the operator of
// equation 1.
#include "wilt/water/permeation.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr int kMaxIterations = 1000;

// The message is made only when it is needed: there is one check for every cell and step.
template <class... Values>
void require(bool good, fmt::format_string<Values...> message, Values&&... values) {
  if (!good) throw Error(ErrorCode::simulation, fmt::format(message, std::forward<Values>(values)...));
}

void check_cells(const Eigen::VectorXd& dry, const Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                 double dt, Eigen::Index cells) {
  require(dt > 0.0 && std::isfinite(dt), "the time step is {}; it must be above 0", dt);
  require(dry.size() == cells && water.size() == cells && loss.size() == cells,
          "{} dry masses, {} waters and {} losses for {} cells; give one per cell", dry.size(), water.size(),
          loss.size(), cells);
  for (int i = 0; i < cells; ++i) {
    require(dry[i] > 0.0 && std::isfinite(dry[i]), "the dry mass of cell {} is {}; it must be above 0", i,
            dry[i]);
    require(water[i] >= 0.0 && std::isfinite(water[i]), "the water of cell {} is {}; it must be 0 or more", i,
            water[i]);
    require(loss[i] >= 0.0 && std::isfinite(loss[i]), "the loss of cell {} is {}; it must be 0 or more", i,
            loss[i]);
  }
}

}  // namespace

void PermeationOptions::validate() const {
  const auto demand = [](bool good, const char* name, double value, const char* allowed) {
    if (!good)
      throw Error(ErrorCode::configuration, fmt::format("{} is {}; it must be {}", name, value, allowed));
  };
  demand(lambda >= 0.0 && std::isfinite(lambda), "lambda", lambda, "0 or more");
  demand(min_water > 0.0 && std::isfinite(min_water), "min_water", min_water, "above 0");
  demand(tolerance > 0.0 && tolerance < 1.0, "tolerance", tolerance, "between 0 and 1");
}

struct Permeation::Impl {
  Edges edges;
  Eigen::VectorXd rest_lengths;
  Eigen::VectorXd length_sums;  // per vertex, of the incident edges
  double mean_length_sum = 0.0;
  PermeationOptions options;
  SparseRows matrix;
  std::vector<int> diagonal;            // where entry (i, i) stands in matrix.valuePtr()
  std::vector<std::array<int, 2>> off;  // (i, j) and (j, i) of each edge
  Eigen::VectorXd conductance;          // g_ij per edge

  void build_pattern(int vertex_count);
  void fill(const Eigen::VectorXd& dry, const Eigen::VectorXd& water, double dt);
  WaterReport bound(Eigen::VectorXd& next, double asked) const;
};

void Permeation::Impl::build_pattern(int vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < vertex_count; ++i) entries.emplace_back(i, i, 1.0);
  for (int e = 0; e < edges.rows(); ++e) {
    entries.emplace_back(edges(e, 0), edges(e, 1), 1.0);
    entries.emplace_back(edges(e, 1), edges(e, 0), 1.0);
  }
  matrix.resize(vertex_count, vertex_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const auto place = [&](int i, int j) {
    const int* begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[i];
    const int* end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[i + 1];
    return static_cast<int>(std::lower_bound(begin, end, j) - matrix.innerIndexPtr());
  };
  for (int i = 0; i < vertex_count; ++i) diagonal.push_back(place(i, i));
  for (int e = 0; e < edges.rows(); ++e)
    off.push_back({place(edges(e, 0), edges(e, 1)), place(edges(e, 1), edges(e, 0))});
}

void Permeation::Impl::fill(const Eigen::VectorXd& dry, const Eigen::VectorXd& water, double dt) {
  double* values = matrix.valuePtr();
  std::fill(values, values + matrix.nonZeros(), 0.0);
  for (int i = 0; i < dry.size(); ++i) values[diagonal[i]] = dry[i];
  for (int e = 0; e < edges.rows(); ++e) {
    const int i = edges(e, 0), j = edges(e, 1);
    const double g = 2.0 * options.lambda * dry[i] * dry[j] /
                     (mean_length_sum * rest_lengths[e] * (dry[i] + water[i] + dry[j] + water[j]));
    conductance[e] = g;
    values[diagonal[i]] += dt * g;
    values[diagonal[j]] += dt * g;
    for (const int place : off[e]) values[place] -= dt * g;
  }
}

// Raises every cell to the lower bound; `asked` is the water that the loss asked for.
WaterReport Permeation::Impl::bound(Eigen::VectorXd& next, double asked) const {
  require(next.allFinite(), "the water of a cell is no longer finite; take a smaller step");
  WaterReport report;
  for (int i = 0; i < next.size(); ++i) {
    if (next[i] > options.min_water) continue;
    report.withheld += options.min_water - next[i];
    ++report.dry_cells;
    next[i] = options.min_water;
  }
  report.lost = asked - report.withheld;
  return report;
}

Permeation::Permeation(int vertex_count, const Edges& edges, const Eigen::VectorXd& rest_lengths,
                       const PermeationOptions& options)
    : impl_(std::make_unique<Impl>()) {
  options.validate();
  if (rest_lengths.size() != edges.rows())
    throw Error(ErrorCode::input, fmt::format("{} rest lengths for {} edges; give one per edge",
                                              rest_lengths.size(), edges.rows()));
  if (vertex_count < 1 || edges.rows() < 1)
    throw Error(ErrorCode::input, fmt::format("{} cells and {} edges; permeation needs at least one of each",
                                              vertex_count, edges.rows()));
  impl_->length_sums = Eigen::VectorXd::Zero(vertex_count);
  for (int e = 0; e < edges.rows(); ++e) {
    const int i = edges(e, 0), j = edges(e, 1);
    if (i < 0 || j < 0 || i >= vertex_count || j >= vertex_count || i == j)
      throw Error(ErrorCode::input,
                  fmt::format("edge {} joins cells {} and {}; they must differ and lie in 0 .. {}", e, i, j,
                              vertex_count - 1));
    if (!(rest_lengths[e] > 0.0) || !std::isfinite(rest_lengths[e]))
      throw Error(ErrorCode::input,
                  fmt::format("the rest length of edge {} is {}; it must be above 0", e, rest_lengths[e]));
    impl_->length_sums[i] += rest_lengths[e];
    impl_->length_sums[j] += rest_lengths[e];
  }
  impl_->edges = edges;
  impl_->rest_lengths = rest_lengths;
  impl_->mean_length_sum = impl_->length_sums.mean();
  impl_->options = options;
  impl_->conductance = Eigen::VectorXd::Zero(edges.rows());
  impl_->build_pattern(vertex_count);
}

Permeation::~Permeation() = default;
Permeation::Permeation(Permeation&&) noexcept = default;
Permeation& Permeation::operator=(Permeation&&) noexcept = default;

WaterReport Permeation::step(const Eigen::VectorXd& dry, Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                             double dt) {
  check_cells(dry, water, loss, dt, impl_->length_sums.size());
  impl_->fill(dry, water, dt);
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(impl_->options.tolerance);
  solver.setMaxIterations(kMaxIterations);
  solver.compute(impl_->matrix);
  const Eigen::VectorXd u = solver.solveWithGuess(water - dt * loss, water.cwiseQuotient(dry));

  Eigen::VectorXd next = water - dt * loss;
  for (int e = 0; e < impl_->edges.rows(); ++e) {
    const int i = impl_->edges(e, 0), j = impl_->edges(e, 1);
    const double flow = dt * impl_->conductance[e] * (u[j] - u[i]);
    next[i] += flow;
    next[j] -= flow;
  }
  WaterReport report = impl_->bound(next, dt * loss.sum());
  report.iterations = static_cast<int>(solver.iterations());
  report.residual = solver.error();
  report.converged = solver.info() == Eigen::Success;
  water = std::move(next);
  return report;
}

WaterReport Permeation::printed_step(const Eigen::VectorXd& dry, Eigen::VectorXd& water,
                                     const Eigen::VectorXd& loss, double dt) {
  check_cells(dry, water, loss, dt, impl_->length_sums.size());
  Eigen::VectorXd laplacian = Eigen::VectorXd::Zero(water.size());
  for (int e = 0; e < impl_->edges.rows(); ++e) {
    const int i = impl_->edges(e, 0), j = impl_->edges(e, 1);
    const double flow = impl_->options.lambda * (dry[i] * water[j] - dry[j] * water[i]) /
                        (impl_->rest_lengths[e] * (dry[i] + water[i] + dry[j] + water[j]));
    laplacian[i] += 2.0 * flow / impl_->length_sums[i];
    laplacian[j] -= 2.0 * flow / impl_->length_sums[j];
  }
  Eigen::VectorXd next = water - dt * loss;
  for (int i = 0; i < next.size(); ++i) {
    const double divisor = 1.0 - dt * laplacian[i];
    require(divisor > 0.0,
            "the printed permeation divides cell {} by {}; take a smaller step or the conservative form", i,
            divisor);
    next[i] /= divisor;
  }
  WaterReport report = impl_->bound(next, dt * loss.sum());
  report.lost = water.sum() - next.sum();
  water = std::move(next);
  return report;
}

}  // namespace wilt
