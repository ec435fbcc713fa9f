// Symbols (paper, section 4.3): w water, b dry mass, m = w + b, l_ij rest length, lambda diffusion
// coefficient, E the normalising length, u = w/b, g_ij the conductance of edge ij, L the operator of
// equation 1.
#include "wilt/water/permeation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/core/index_lists.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

constexpr int kMaxIterations = 1000;
constexpr int kGrain = 4096;  // cells that one thread takes

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

// One place for every edge at either end: those of cell i stand from starts[i] to starts[i + 1]. Every cell
// gathers from its neighbours, so that cells can be worked on at the same time.
struct Permeation::Impl {
  std::vector<int> starts, neighbours;
  Eigen::VectorXd rest_lengths;  // per place
  Eigen::VectorXd length_sums;   // per vertex, of the incident edges
  double mean_length_sum = 0.0;
  PermeationOptions options;
  Eigen::VectorXd conductance, diagonal;  // dt g_ij per place; b_i + dt sum_j g_ij

  int cells() const { return static_cast<int>(length_sums.size()); }
  void build(int vertex_count, const Edges& edges, const Eigen::VectorXd& lengths);
  void fill(const Eigen::VectorXd& dry, const Eigen::VectorXd& mass, double dt);
  Eigen::VectorXd times(const Eigen::VectorXd& u) const;
  Eigen::VectorXd solve(const Eigen::VectorXd& right, Eigen::VectorXd u, WaterReport& report) const;
  WaterReport bound(Eigen::VectorXd& next, double asked) const;
};

void Permeation::Impl::build(int vertex_count, const Edges& edges, const Eigen::VectorXd& lengths) {
  std::vector<std::pair<int, int>> ends;
  ends.reserve(static_cast<std::size_t>(edges.size()));
  for (int end = 0; end < edges.size(); ++end) ends.emplace_back(edges.data()[end], end);
  const IndexLists ends_of(vertex_count, ends);
  rest_lengths.resize(edges.size());
  conductance.resize(edges.size());
  diagonal.resize(vertex_count);
  starts = {0};
  for (int i = 0; i < vertex_count; ++i) {
    for (const int end : ends_of[i]) {
      rest_lengths[static_cast<Eigen::Index>(neighbours.size())] = lengths[end / 2];
      neighbours.push_back(edges.data()[end ^ 1]);
    }
    starts.push_back(static_cast<int>(neighbours.size()));
  }
}

void Permeation::Impl::fill(const Eigen::VectorXd& dry, const Eigen::VectorXd& mass, double dt) {
  parallel_for(cells(), kGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      diagonal[i] = dry[i];
      for (int place = starts[i]; place < starts[i + 1]; ++place) {
        const int j = neighbours[place];
        conductance[place] = dt * 2.0 * options.lambda * (dry[i] * dry[j]) /
                             (mean_length_sum * rest_lengths[place] * (mass[i] + mass[j]));
        diagonal[i] += conductance[place];
      }
    }
  });
}

Eigen::VectorXd Permeation::Impl::times(const Eigen::VectorXd& u) const {
  Eigen::VectorXd product(u.size());
  parallel_for(cells(), kGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      double sum = diagonal[i] * u[i];
      for (int place = starts[i]; place < starts[i + 1]; ++place)
        sum -= conductance[place] * u[neighbours[place]];
      product[i] = sum;
    }
  });
  return product;
}

// Conjugate gradients from `u`, preconditioned by the diagonal.
Eigen::VectorXd Permeation::Impl::solve(const Eigen::VectorXd& right, Eigen::VectorXd u,
                                        WaterReport& report) const {
  const auto dot = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return parallel_sum(static_cast<int>(a.size()), kGrain, [&](int begin, int end) {
      return a.segment(begin, end - begin).dot(b.segment(begin, end - begin));
    });
  };
  const double scale = std::sqrt(dot(right, right));
  Eigen::VectorXd residual = right - times(u), towards = residual.cwiseQuotient(diagonal);
  double descent = dot(residual, towards);
  report.residual = scale > 0.0 ? std::sqrt(dot(residual, residual)) / scale : 0.0;
  while (report.residual > options.tolerance && report.iterations < kMaxIterations) {
    const Eigen::VectorXd change = times(towards);
    const double step = descent / dot(towards, change);
    u += step * towards;
    residual -= step * change;
    const Eigen::VectorXd next = residual.cwiseQuotient(diagonal);
    const double next_descent = dot(residual, next);
    towards = next + (next_descent / descent) * towards;
    descent = next_descent;
    report.residual = std::sqrt(dot(residual, residual)) / scale;
    ++report.iterations;
  }
  report.converged = report.residual <= options.tolerance;
  return u;
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
  impl_->mean_length_sum = impl_->length_sums.mean();
  impl_->options = options;
  impl_->build(vertex_count, edges, rest_lengths);
}

Permeation::~Permeation() = default;
Permeation::Permeation(Permeation&&) noexcept = default;
Permeation& Permeation::operator=(Permeation&&) noexcept = default;

void Permeation::set_lambda(double lambda) {
  PermeationOptions options = impl_->options;
  options.lambda = lambda;
  options.validate();
  impl_->options = options;
}

WaterReport Permeation::step(const Eigen::VectorXd& dry, Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                             double dt) {
  Impl& p = *impl_;
  check_cells(dry, water, loss, dt, p.cells());
  p.fill(dry, dry + water, dt);
  WaterReport solved;
  const Eigen::VectorXd u = p.solve(water - dt * loss, water.cwiseQuotient(dry), solved);
  Eigen::VectorXd next(water.size());
  parallel_for(p.cells(), kGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      next[i] = water[i] - dt * loss[i];
      for (int place = p.starts[i]; place < p.starts[i + 1]; ++place)
        next[i] += p.conductance[place] * (u[p.neighbours[place]] - u[i]);
    }
  });
  WaterReport report = p.bound(next, dt * loss.sum());
  report.iterations = solved.iterations;
  report.residual = solved.residual;
  report.converged = solved.converged;
  water = std::move(next);
  return report;
}

WaterReport Permeation::printed_step(const Eigen::VectorXd& dry, Eigen::VectorXd& water,
                                     const Eigen::VectorXd& loss, double dt) {
  const Impl& p = *impl_;
  check_cells(dry, water, loss, dt, p.cells());
  const Eigen::VectorXd mass = dry + water;
  Eigen::VectorXd divisor(water.size());
  parallel_for(p.cells(), kGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      double sum = 0.0;
      for (int place = p.starts[i]; place < p.starts[i + 1]; ++place) {
        const int j = p.neighbours[place];
        sum += p.options.lambda * (dry[i] * water[j] - dry[j] * water[i]) /
               (p.rest_lengths[place] * (mass[i] + mass[j]));
      }
      divisor[i] = 1.0 - dt * 2.0 * sum / p.length_sums[i];
    }
  });
  for (int i = 0; i < divisor.size(); ++i) {
    require(divisor[i] > 0.0,
            "the printed permeation divides cell {} by {}; take a smaller dt or --model cell", i, divisor[i]);
  }
  Eigen::VectorXd next = (water - dt * loss).cwiseQuotient(divisor);
  WaterReport report = p.bound(next, dt * loss.sum());
  report.lost = water.sum() - next.sum();
  water = std::move(next);
  return report;
}

double Permeation::printed_number(const Eigen::VectorXd& dry, const Eigen::VectorXd& water, double dt) const {
  const Impl& p = *impl_;
  double total = 0.0;
  for (int i = 0; i < p.cells(); ++i) {
    double sum = 0.0;
    for (int place = p.starts[i]; place < p.starts[i + 1]; ++place) {
      const int j = p.neighbours[place];
      sum += p.options.lambda * dry[j] / (p.rest_lengths[place] * (dry[i] + water[i] + dry[j] + water[j]));
    }
    total += dt * water[i] / dry[i] * 2.0 * sum / p.length_sums[i];
  }
  return total / p.cells();
}

}  // namespace wilt
