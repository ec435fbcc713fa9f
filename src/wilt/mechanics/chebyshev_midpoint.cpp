// Symbols: x0, v0 the state at the start, u the midpoint, R the residual, r = -w R with w = dt^2/(4 m), p the
// direction of the iteration.
#include "wilt/mechanics/chebyshev_midpoint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "wilt/core/parallel.hpp"

namespace wilt::detail {
namespace {

using simd::kLanes;
using simd::larger;

constexpr int kGroups = 128;   // per block of a sum, and per parallel task
constexpr double kFlat = 0.6;  // the largest row sum of sum_j n n^T over the degree: 1/2 in a plane, and room
constexpr double kEstimate = 0.5;      // below it the spectrum is estimated, above it bounded
constexpr double kLargestHigh = 60.0;  // beyond it, more than a hundred passes
constexpr double kLargestLow = 0.5;    // beyond it, compressed springs make the system all but indefinite
constexpr int kMargin = 10;            // passes beyond twice those that the spectrum promises
constexpr double kRoundOff = 4.0 * std::numeric_limits<double>::epsilon();

WILT_INLINE Double8 positive(Double8 v) {
  return larger(v, Double8{});
}
WILT_INLINE Double8 magnitude(Double8 v) {
  return larger(v, -v);
}
double largest(Double8 v) {
  double result = 0.0;
  for (int l = 0; l < kLanes; ++l) result = std::max(result, v[l]);
  return result;
}

// A symmetric 3 x 3 tensor in every lane.
struct Tensor8 {
  Double8 xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  // += along n n^T + across (1 - n n^T)
  WILT_INLINE void add(Double8 along, Double8 across, const Point8& n) {
    const Double8 d = along - across;
    xx += d * n.x * n.x + across, yy += d * n.y * n.y + across, zz += d * n.z * n.z + across;
    xy += d * n.x * n.y, xz += d * n.x * n.z, yz += d * n.y * n.z;
  }
  WILT_INLINE Double8 largest_row_sum() const {
    const Double8 a = magnitude(xy), b = magnitude(xz), c = magnitude(yz);
    return larger(larger(xx + a + b, yy + a + c), zz + b + c);
  }
};

struct BeginPass {
  const int* vertices;
  const double *x, *v, *a, *jerk, *load;  // public vectors, #V x 3
  double dt;
  Number8 *inertia, *weight;  // the first holds the masses, 0 where pinned
  Point4 *start, *u;
  Point8* constant;
};

// Squared norms.
struct Squares {
  double momentum = 0.0, load = 0.0, inertia = 0.0, position = 0.0;  // 2 m v0/dt, load, m a, 4 m/dt^2 x0
};

// Brings some groups into the rows' order: x0, the first guess of u, and r's constant x0 + dt/2 v0 + w load.
WILT_CLONES Squares begin_groups(const BeginPass& pass, int begin, int end) {
  const double dt = pass.dt, half = 0.5 * dt, quarter = 0.25 * dt * dt;
  Double8 momentum{}, loads{}, inertia{}, position{};
  for (int g = begin; g < end; ++g) {
    const int* vertices = pass.vertices + kLanes * g;
    const Double8 m = pass.inertia[g].lanes, free = m > 0.0 ? Double8{} + 1.0 : Double8{};
    const Double8 w = m > 0.0 ? quarter / m : Double8{};
    pass.inertia[g].lanes = m / quarter;
    pass.weight[g].lanes = w;
    const Point8 x = simd::gather(pass.x, vertices), v = simd::gather(pass.v, vertices);
    const Point8 a = simd::gather(pass.a, vertices), load = simd::gather(pass.load, vertices);
    const Point8 predicted = x + half * free * v;
    simd::store_points(pass.start + kLanes * g, x);
    simd::store_points(pass.u + kLanes * g,
                       predicted + quarter * free * (a + dt * simd::gather(pass.jerk, vertices)));
    pass.constant[g] = predicted + w * load;
    momentum += 4.0 / (dt * dt) * m * m * dot(v, v);
    loads += free * dot(load, load);
    inertia += m * m * dot(a, a);
    position += 16.0 / (dt * dt * dt * dt) * m * m * dot(x, x);
  }
  return {simd::sum(momentum), simd::sum(loads), simd::sum(inertia), simd::sum(position)};
}

struct StartPass {
  const EdgeRows* rows;
  const Number8 *stretch, *push, *damping;
  double damping_scale;  // 2/dt
  const Number8* weight;
  const Point4* x;
  Point8* constant;
};

// The bounds of the spectrum at x0 over some groups.
WILT_CLONES void bounds_of_groups(const StartPass& pass, int begin, int end, double* low, double* high) {
  Double8 largest_low{}, largest_high{};
  for (int g = begin; g < end; ++g) {
    const Point8 xi = simd::load_points(pass.x + kLanes * g);
    Tensor8 stiffness;
    Double8 softness{};
    for (int s = pass.rows->group_begin[g]; s < pass.rows->group_begin[g + 1]; ++s) {
      const Point8 d = simd::gather(pass.x, pass.rows->neighbours.data() + kLanes * s) - xi;
      const Double8 inverse = 1.0 / simd::sqrt(dot(d, d) + simd::kTiny);
      const Double8 stretch = pass.stretch[s].lanes, damping = pass.damping_scale * pass.damping[s].lanes;
      const Double8 across = stretch - pass.push[s].lanes * inverse;
      stiffness.add(stretch + damping, positive(across) + damping, inverse * d);
      softness += positive(-across);
    }
    const Double8 w = pass.weight[g].lanes;
    largest_high = larger(largest_high, 2.0 * w * stiffness.largest_row_sum());
    largest_low = larger(largest_low, 2.0 * w * softness);
  }
  *low = largest(largest_low);
  *high = largest(largest_high);
}

// constant -= w sum_j 2/dt damping x0_ij: the damping of u - x0, not of u, is wanted.
WILT_CLONES void take_off_damping_of_groups(const StartPass& pass, int begin, int end) {
  for (int g = begin; g < end; ++g) {
    const Point8 xi = simd::load_points(pass.x + kLanes * g);
    Point8 drag;
    for (int s = pass.rows->group_begin[g]; s < pass.rows->group_begin[g + 1]; ++s)
      drag = drag +
             pass.damping[s].lanes * (simd::gather(pass.x, pass.rows->neighbours.data() + kLanes * s) - xi);
    pass.constant[g] = pass.constant[g] - pass.damping_scale * pass.weight[g].lanes * drag;
  }
}

struct IterationPass {
  const EdgeRows* rows;
  const Number8 *pull, *push;
  double alpha, beta;
  const Number8 *weight, *inertia;
  const Point8* constant;
  const Point4* u;
  Point4* u_next;
  Point8* direction;
};

// One pass over some groups; the sum of their |R|^2.
WILT_CLONES double iterate_groups(const IterationPass& pass, int begin, int end) {
  Double8 sum{};
  for (int g = begin; g < end; ++g) {
    const Point8 u = simd::load_points(pass.u + kLanes * g);
    Point8 f;
    for (int s = pass.rows->group_begin[g]; s < pass.rows->group_begin[g + 1]; ++s) {
      const Point8 edge = simd::gather(pass.u, pass.rows->neighbours.data() + kLanes * s) - u;
      f = f + (pass.pull[s].lanes - pass.push[s].lanes / simd::sqrt(dot(edge, edge) + simd::kTiny)) * edge;
    }
    const Point8 r = pass.constant[g] + pass.weight[g].lanes * f - u, residual = pass.inertia[g].lanes * r;
    sum += dot(residual, residual);
    const Point8 p = pass.alpha * r + pass.beta * pass.direction[g];
    pass.direction[g] = p;
    simd::store_points(pass.u_next + kLanes * g, u + p);
  }
  return simd::sum(sum);
}

struct FinishPass {
  const int* vertices;
  int vertex_count;
  double dt;
  const Number8* weight;
  const Point4 *start, *u;
  double *x, *v, *a, *jerk;  // public vectors, #V x 3
};

WILT_INLINE void scatter(const Point8& p, const int* vertices, int count, double* to) {
  std::array<Point4, kLanes> points;
  simd::store_points(points.data(), p);
  for (int l = 0; l < count; ++l) {
    double* out = to + 3 * static_cast<std::ptrdiff_t>(vertices[l]);
    for (int k = 0; k < 3; ++k) out[k] = points[l].xyz[k];
  }
}

// The state at the end of the step from the midpoint, in the public order.
WILT_CLONES void finish_groups(const FinishPass& pass, int begin, int end) {
  const double dt = pass.dt;
  for (int g = begin; g < end; ++g) {
    const int* vertices = pass.vertices + kLanes * g;
    const int count = std::min(kLanes, pass.vertex_count - kLanes * g);
    const Double8 w = pass.weight[g].lanes, free = w > 0.0 ? Double8{} + 1.0 : Double8{};
    const Point8 x0 = simd::load_points(pass.start + kLanes * g);
    const Point8 v0 = simd::gather(pass.v, vertices), a0 = simd::gather(pass.a, vertices);
    const Point8 d = 2.0 * (simd::load_points(pass.u + kLanes * g) - x0);
    const Point8 v1 = free * (2.0 / dt * d - v0), a1 = 1.0 / dt * (v1 - v0);
    scatter(x0 + d, vertices, count, pass.x);
    scatter(v1, vertices, count, pass.v);
    scatter(a1, vertices, count, pass.a);
    scatter(1.0 / dt * (a1 - a0), vertices, count, pass.jerk);
  }
}

// body(block, first group, last group) for all blocks of groups, in parallel.
template <class Body>
void for_blocks(Crew& crew, int groups, const Body& body) {
  crew.for_each((groups + kGroups - 1) / kGroups,
                [&](int block) { body(block, block * kGroups, std::min(groups, (block + 1) * kGroups)); });
}

}  // namespace

ChebyshevMidpoint::ChebyshevMidpoint(const SpringNetwork& network)
    : network_(network),
      pull_(network.rows().slot_count()),
      stretch_sum_(network.rows().group_count()),
      damping_sum_(stretch_sum_.size()),
      weight_(stretch_sum_.size()),
      inertia_(stretch_sum_.size()),
      start_(network.rows().row_count()),
      u_(start_.size()),
      u_next_(start_.size()),
      constant_(stretch_sum_.size()),
      direction_(stretch_sum_.size()) {}

// What depends on the springs' stiffness and the step alone.
void ChebyshevMidpoint::combine(Crew& crew, double dt) {
  if (revision_ == network_.stiffness_revision() && dt_ == dt) return;
  revision_ = network_.stiffness_revision();
  dt_ = dt;
  for_blocks(crew, network_.rows().group_count(), [&](int, int begin, int end) {
    for (int g = begin; g < end; ++g) {
      Double8 stretch{}, damping{};
      for (int s = network_.rows().group_begin[g]; s < network_.rows().group_begin[g + 1]; ++s) {
        const Double8 drag = 2.0 / dt * network_.damping()[s].lanes;
        pull_[s].lanes = network_.stretch()[s].lanes + drag;
        stretch += network_.stretch()[s].lanes;
        damping += drag;
      }
      stretch_sum_[g].lanes = stretch;
      damping_sum_[g].lanes = damping;
    }
  });
}

ChebyshevMidpoint::Scales ChebyshevMidpoint::begin(Crew& crew, const System& system, const Points3& load,
                                                   const MotionState& state, double dt) {
  const EdgeRows& rows = network_.rows();
  std::vector<Squares> squares((rows.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, rows.group_count(), [&](int block, int begin, int end) {
    for (int row = kLanes * begin; row < kLanes * end; ++row) {
      const int v = rows.vertices[row];
      const bool free = row < rows.vertex_count() && !system.pinned()[v];
      inertia_[row / kLanes].lanes[row % kLanes] = free ? system.masses()[v] : 0.0;
    }
    squares[block] =
        begin_groups({rows.vertices.data(), state.positions.data(), state.velocities.data(),
                      state.accelerations.data(), state.jerks.data(), load.data(), dt, inertia_.data(),
                      weight_.data(), start_.data(), u_.data(), constant_.data()},
                     begin, end);
  });
  Squares sum;
  for (const Squares& s : squares) {
    sum.momentum += s.momentum;
    sum.load += s.load;
    sum.inertia += s.inertia;
    sum.position += s.position;
  }
  return {std::sqrt(std::max({sum.momentum, sum.load, sum.inertia})), kRoundOff * std::sqrt(sum.position)};
}

ChebyshevMidpoint::Spectrum ChebyshevMidpoint::spectrum(Crew& crew) const {
  Spectrum result{0.0, 0.0};
  for (std::size_t g = 0; g < weight_.size(); ++g) {
    const Double8 stiffness = kFlat * stretch_sum_[g].lanes + damping_sum_[g].lanes;
    result.high = std::max(result.high, largest(2.0 * weight_[g].lanes * stiffness));
  }
  if (result.high < kEstimate) return result;
  const EdgeRows& rows = network_.rows();
  std::vector<Spectrum> bounds((rows.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, rows.group_count(), [&](int block, int begin, int end) {
    bounds_of_groups({&rows, network_.stretch(), network_.push(), network_.damping(), 2.0 / dt_,
                      weight_.data(), start_.data(), nullptr},
                     begin, end, &bounds[block].low, &bounds[block].high);
  });
  result.high = 0.0;
  for (const Spectrum& bound : bounds)
    result = {std::max(result.low, bound.low), std::max(result.high, bound.high)};
  return result;
}

void ChebyshevMidpoint::take_off_damping(Crew& crew) {
  const EdgeRows& rows = network_.rows();
  for_blocks(crew, rows.group_count(), [&](int, int begin, int end) {
    take_off_damping_of_groups({&rows, network_.stretch(), network_.push(), network_.damping(), 2.0 / dt_,
                                weight_.data(), start_.data(), constant_.data()},
                               begin, end);
  });
}

// Moves on along p; returns ||R|| where it stood.
double ChebyshevMidpoint::pass(Crew& crew, double alpha, double beta) {
  const EdgeRows& rows = network_.rows();
  const IterationPass pass{.rows = &rows,
                           .pull = pull_.data(),
                           .push = network_.push(),
                           .alpha = alpha,
                           .beta = beta,
                           .weight = weight_.data(),
                           .inertia = inertia_.data(),
                           .constant = constant_.data(),
                           .u = u_.data(),
                           .u_next = u_next_.data(),
                           .direction = direction_.data()};
  std::vector<double> sums((rows.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, rows.group_count(),
             [&](int block, int begin, int end) { sums[block] = iterate_groups(pass, begin, end); });
  std::swap(u_, u_next_);
  return std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0));
}

ChebyshevReport ChebyshevMidpoint::solve(const System& system, const Points3& load, MotionState& state,
                                         double dt, double tolerance) {
  ChebyshevReport report;
  Crew crew;
  combine(crew, dt);
  const Scales scales = begin(crew, system, load, state, dt);
  const Spectrum spectrum = this->spectrum(crew);
  if (!(spectrum.high <= kLargestHigh) || !(spectrum.low <= kLargestLow)) return report;
  if (network_.damped()) take_off_damping(crew);
  std::fill(direction_.begin(), direction_.end(), Point8{});

  const double centre = 1.0 + 0.5 * (spectrum.high - spectrum.low);
  const double half = std::max(0.5 * (spectrum.high + spectrum.low), 1e-9);
  const double root = std::sqrt((centre + half) / (centre - half)), rate = (root - 1.0) / (root + 1.0);
  double alpha = 1.0 / centre, beta = 0.0, rho = half / centre, target = 0.0, most = kMargin;
  for (;;) {
    report.residual = pass(crew, alpha, beta);
    if (report.passes++ == 0) {
      report.scale = std::max(scales.force, report.residual);
      const double round_off = (1.0 + spectrum.high) * scales.round_off;
      target = std::max(tolerance * report.scale, round_off);
      report.scale = std::max(report.scale, round_off / tolerance);
      most += 2.0 * std::max(0.0, std::log(target / report.residual) / std::log(rate));
    }
    if (report.residual <= target) break;
    if (!std::isfinite(report.residual) || report.passes > most) return report;
    // Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1.
    const double next = 1.0 / (2.0 * centre / half - rho);
    alpha = 2.0 * next / half;
    beta = next * rho;
    rho = next;
  }
  std::swap(u_, u_next_);  // the residual is that of the point before the last move
  finish(crew, state, dt);
  report.converged = true;
  return report;
}

void ChebyshevMidpoint::finish(Crew& crew, MotionState& state, double dt) const {
  const EdgeRows& rows = network_.rows();
  for_blocks(crew, rows.group_count(), [&](int, int begin, int end) {
    finish_groups(
        {rows.vertices.data(), rows.vertex_count(), dt, weight_.data(), start_.data(), u_.data(),
         state.positions.data(), state.velocities.data(), state.accelerations.data(), state.jerks.data()},
        begin, end);
  });
}

}  // namespace wilt::detail
