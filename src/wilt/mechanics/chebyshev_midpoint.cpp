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
#include "wilt/mechanics/leaf_lanes.hpp"

namespace wilt::detail {
namespace {

using simd::kLanes;

constexpr int kGroups = 128;      // per block of a sum, and per parallel task
constexpr double kTiny = 1e-300;  // added to squared lengths: an edge without length pulls nowhere
constexpr double kFlat = 0.6;  // the largest row sum of sum_j n n^T over the degree: 1/2 in a plane, and room
constexpr double kEstimate = 0.5;      // below it the spectrum is estimated, above it bounded
constexpr double kLargestHigh = 60.0;  // beyond it, more than a hundred passes
constexpr double kLargestLow = 0.5;    // beyond it, compressed springs make the system all but indefinite
constexpr int kMargin = 10;            // passes beyond twice those that the spectrum promises
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRoundOff = 4.0 * std::numeric_limits<double>::epsilon();

WILT_INLINE Double8 larger(Double8 a, Double8 b) {
  return a > b ? a : b;
}
WILT_INLINE Double8 positive(Double8 v) {
  return larger(v, Double8{});
}
WILT_INLINE Double8 magnitude(Double8 v) {
  return larger(v, -v);
}
// The largest of the lanes of one leaf, in all of them.
template <class Lanes>
WILT_INLINE Double8 largest_of_leaf(Double8 v) {
  if (Lanes::kLeaves == kLanes) return v;
  double result = 0.0;
  for (int l = 0; l < kLanes; ++l) result = std::max(result, v[l]);
  return Double8{} + result;
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

// Squared norms: of 2 m v0/dt, the load, m a and 4 m/dt^2 x0.
struct alignas(64) Squares {
  Double8 momentum{}, load{}, inertia{}, position{};

  void add(const Squares& other) {
    momentum += other.momentum, load += other.load, inertia += other.inertia, position += other.position;
  }
};

template <class Lanes>
struct BeginPass {
  const int* vertices;
  typename Lanes::template Leaves<const double> x, v, a, jerk, load;
  double dt;
  const Number8* weight;
  typename Lanes::Stored *start, *u;
  Point8* constant;
};

// Brings some groups into the rows' order: x0, the first guess of u, and r's constant x0 + dt/2 v0 + w load.
template <class Lanes>
WILT_INLINE void begin_groups(const BeginPass<Lanes>& pass, int begin, int end, Squares& squares) {
  const double dt = pass.dt, half = 0.5 * dt, quarter = 0.25 * dt * dt;
  for (int g = begin; g < end; ++g) {
    const Double8 w = pass.weight[g].lanes;
    const Double8 free = w > 0.0 ? Double8{} + 1.0 : Double8{}, m = w > 0.0 ? quarter / w : Double8{};
    const auto load_of = [&](const auto& leaves) __attribute__((always_inline)) {
      return Lanes::load(leaves, pass.vertices, g);
    };
    const Point8 x = load_of(pass.x), v = load_of(pass.v), a = load_of(pass.a), load = load_of(pass.load);
    const Point8 predicted = x + half * free * v;
    Lanes::store(pass.start, g, x);
    Lanes::store(pass.u, g, predicted + quarter * free * (a + dt * load_of(pass.jerk)));
    pass.constant[g] = predicted + w * load;
    squares.momentum += 4.0 / (dt * dt) * m * m * dot(v, v);
    squares.load += free * dot(load, load);
    squares.inertia += m * m * dot(a, a);
    squares.position += 16.0 / (dt * dt * dt * dt) * m * m * dot(x, x);
  }
}

// What the passes over the edges read.
struct Graph {
  const int *slot_begin, *neighbours;
  const Number8 *stretch, *push, *damping;
  double damping_scale;  // 2/dt
};

template <class Lanes>
struct StartPass {
  Graph graph;
  const Number8* weight;
  const typename Lanes::Stored* x;
  Point8* constant;
};

struct alignas(64) Bounds {
  Double8 low{}, high{};
};

// The bounds of the spectrum at x0 over some groups.
template <class Lanes>
WILT_INLINE void bounds_of_groups(const StartPass<Lanes>& pass, int begin, int end, Bounds& bounds) {
  for (int g = begin; g < end; ++g) {
    const Point8 xi = Lanes::own(pass.x, g);
    Tensor8 stiffness;
    Double8 softness{};
    for (int s = pass.graph.slot_begin[g]; s < pass.graph.slot_begin[g + 1]; ++s) {
      const Point8 d = Lanes::neighbours(pass.x, pass.graph.neighbours, s) - xi;
      const Double8 inverse = 1.0 / simd::sqrt(dot(d, d) + kTiny);
      const Double8 stretch = pass.graph.stretch[s].lanes;
      const Double8 damping = pass.graph.damping_scale * pass.graph.damping[s].lanes;
      const Double8 across = stretch - pass.graph.push[s].lanes * inverse;
      stiffness.add(stretch + damping, positive(across) + damping, inverse * d);
      softness += positive(-across);
    }
    const Double8 w = pass.weight[g].lanes;
    bounds.high = larger(bounds.high, 2.0 * w * stiffness.largest_row_sum());
    bounds.low = larger(bounds.low, 2.0 * w * softness);
  }
}

// constant -= w sum_j 2/dt damping x0_ij: the damping of u - x0, not of u, is wanted.
template <class Lanes>
WILT_INLINE void take_off_damping_of_groups(const StartPass<Lanes>& pass, int begin, int end) {
  for (int g = begin; g < end; ++g) {
    const Point8 xi = Lanes::own(pass.x, g);
    Point8 drag;
    for (int s = pass.graph.slot_begin[g]; s < pass.graph.slot_begin[g + 1]; ++s)
      drag = drag + pass.graph.damping[s].lanes * (Lanes::neighbours(pass.x, pass.graph.neighbours, s) - xi);
    pass.constant[g] = pass.constant[g] - pass.graph.damping_scale * pass.weight[g].lanes * drag;
  }
}

template <class Lanes>
struct IterationPass {
  const int *slot_begin, *neighbours;
  const Number8 *pull, *push;
  Number8 alpha, beta;
  const Number8 *weight, *inertia;
  const Point8* constant;
  const typename Lanes::Stored* u;
  typename Lanes::Stored* u_next;
  Point8* direction;
};

// One pass over some groups; adds their |R|^2 to `squares`.
template <class Lanes>
WILT_INLINE void iterate_groups(const IterationPass<Lanes>& pass, int begin, int end, Double8& squares) {
  const Double8 alpha = pass.alpha.lanes, beta = pass.beta.lanes;
  Double8 sum{};
  for (int g = begin; g < end; ++g) {
    const Point8 u = Lanes::own(pass.u, g);
    Point8 f;
    for (int s = pass.slot_begin[g]; s < pass.slot_begin[g + 1]; ++s) {
      const Point8 edge = Lanes::neighbours(pass.u, pass.neighbours, s) - u;
      f = f + (pass.pull[s].lanes - pass.push[s].lanes / simd::sqrt(dot(edge, edge) + kTiny)) * edge;
    }
    const Point8 r = pass.constant[g] + pass.weight[g].lanes * f - u, residual = pass.inertia[g].lanes * r;
    sum += dot(residual, residual);
    const Point8 p = alpha * r + beta * pass.direction[g];
    pass.direction[g] = p;
    Lanes::store(pass.u_next, g, u + p);
  }
  squares += sum;
}

template <class Lanes>
struct FinishPass {
  const int* vertices;
  int vertex_count;
  double dt;
  const Number8* weight;
  const typename Lanes::Stored *start, *u;
  typename Lanes::template Leaves<const double> v0, a0;
  typename Lanes::template Leaves<double> x, v, a, jerk;  // null where a leaf keeps its state
};

// The state at the end of the step from the midpoint, in the public order.
template <class Lanes>
WILT_INLINE void finish_groups(const FinishPass<Lanes>& pass, int begin, int end) {
  const double dt = pass.dt;
  for (int g = begin; g < end; ++g) {
    const Double8 w = pass.weight[g].lanes, free = w > 0.0 ? Double8{} + 1.0 : Double8{};
    const Point8 x0 = Lanes::own(pass.start, g);
    const Point8 v0 = Lanes::load(pass.v0, pass.vertices, g);
    const Point8 a0 = Lanes::load(pass.a0, pass.vertices, g);
    const Point8 d = 2.0 * (Lanes::own(pass.u, g) - x0);
    const Point8 v1 = free * (2.0 / dt * d - v0), a1 = 1.0 / dt * (v1 - v0);
    const auto store = [&](const auto& leaves, const Point8& p) __attribute__((always_inline)) {
      Lanes::store(leaves, pass.vertices, g, pass.vertex_count, p);
    };
    store(pass.x, x0 + d);
    store(pass.v, v1);
    store(pass.a, a1);
    store(pass.jerk, 1.0 / dt * (a1 - a0));
  }
}

// The passes, compiled for every class of processor, for both kinds of lanes.
#define WILT_PASSES(Lanes)                                                                       \
  WILT_CLONES void run(const BeginPass<Lanes>& pass, int begin, int end, Squares& squares) {     \
    begin_groups<Lanes>(pass, begin, end, squares);                                              \
  }                                                                                              \
  WILT_CLONES void run(const StartPass<Lanes>& pass, int begin, int end, Bounds& bounds) {       \
    bounds_of_groups<Lanes>(pass, begin, end, bounds);                                           \
  }                                                                                              \
  WILT_CLONES void run(const StartPass<Lanes>& pass, int begin, int end) {                       \
    take_off_damping_of_groups<Lanes>(pass, begin, end);                                         \
  }                                                                                              \
  WILT_CLONES void run(const IterationPass<Lanes>& pass, int begin, int end, Number8& squares) { \
    iterate_groups<Lanes>(pass, begin, end, squares.lanes);                                      \
  }                                                                                              \
  WILT_CLONES void run(const FinishPass<Lanes>& pass, int begin, int end) {                      \
    finish_groups<Lanes>(pass, begin, end);                                                      \
  }
WILT_PASSES(VertexLanes)
WILT_PASSES(LeafLanes)
#undef WILT_PASSES

// body(block, first group, last group) for all blocks of groups, in parallel.
template <class Body>
void for_blocks(Crew& crew, int groups, const Body& body) {
  crew.for_each((groups + kGroups - 1) / kGroups,
                [&](int block) { body(block, block * kGroups, std::min(groups, (block + 1) * kGroups)); });
}

bool none(const Mask8& mask) {
  long any = 0;
  for (int l = 0; l < kLanes; ++l) any |= mask[l];
  return any == 0;
}

// Chebyshev's semi-iteration for a spectrum in [1 - low, 1 + high] (Saad, Iterative Methods for Sparse Linear
// Systems, algorithm 12.1): p <- alpha r + beta p.
struct alignas(64) Semiiteration {
  Double8 centre, half, rho;
  Number8 alpha, beta;

  Semiiteration(Double8 low, Double8 high)
      : centre(1.0 + 0.5 * (high - low)),
        half(larger(0.5 * (high + low), Double8{} + 1e-9)),
        rho(half / centre),
        alpha{1.0 / centre} {}

  void advance() {
    const Double8 next = 1.0 / (2.0 * centre / half - rho);
    alpha.lanes = 2.0 * next / half;
    beta.lanes = next * rho;
    rho = next;
  }
  // What a pass leaves of the residual at least.
  Double8 rate() const {
    const Double8 root = simd::sqrt((centre + half) / (centre - half));
    return (root - 1.0) / (root + 1.0);
  }
};

template <class Network, class Stored>
StartPass<typename Network::Lanes> start_pass(const Network& network, double dt,
                                              const std::vector<Number8>& weight,
                                              const std::vector<Stored>& start, Point8* constant) {
  return {{network.slot_begin(), network.neighbours(), network.stretch(), network.push(), network.damping(),
           2.0 / dt},
          weight.data(),
          start.data(),
          constant};
}

// The numbers of one vector of every leaf's state.
template <class Number, std::size_t kLeaves>
std::array<Number*, kLeaves> data_of(const std::array<StepProblem, kLeaves>& problems,
                                     Points3 MotionState::*vector) {
  std::array<Number*, kLeaves> result;
  for (std::size_t k = 0; k < kLeaves; ++k) result[k] = (problems[k].state->*vector).data();
  return result;
}

}  // namespace

template <class Network>
ChebyshevMidpoint<Network>::ChebyshevMidpoint(const Network& network)
    : network_(network),
      pull_(network.slot_begin()[network.group_count()]),
      stretch_sum_(network.group_count()),
      damping_sum_(stretch_sum_.size()),
      weight_(stretch_sum_.size()),
      inertia_(stretch_sum_.size()),
      start_(Lanes::kStoredPerGroup * stretch_sum_.size()),
      u_(start_.size()),
      u_next_(start_.size()),
      settled_(start_.size()),
      constant_(stretch_sum_.size()),
      direction_(stretch_sum_.size()) {}

// What depends on the springs' stiffness and the step alone.
template <class Network>
void ChebyshevMidpoint<Network>::combine(Crew& crew, double dt) {
  if (revision_ == network_.stiffness_revision() && dt_ == dt) return;
  revision_ = network_.stiffness_revision();
  dt_ = dt;
  for_blocks(crew, network_.group_count(), [&](int, int begin, int end) {
    for (int g = begin; g < end; ++g) {
      Double8 stretch{}, damping{};
      for (int s = network_.slot_begin()[g]; s < network_.slot_begin()[g + 1]; ++s) {
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

template <class Network>
typename ChebyshevMidpoint<Network>::Scales ChebyshevMidpoint<Network>::begin(Crew& crew,
                                                                              const Problems& problems) {
  BeginPass<Lanes> pass{.vertices = network_.vertices(),
                        .x = data_of<const double>(problems, &MotionState::positions),
                        .v = data_of<const double>(problems, &MotionState::velocities),
                        .a = data_of<const double>(problems, &MotionState::accelerations),
                        .jerk = data_of<const double>(problems, &MotionState::jerks),
                        .load = {},
                        .dt = dt_,
                        .weight = weight_.data(),
                        .start = start_.data(),
                        .u = u_.data(),
                        .constant = constant_.data()};
  for (int k = 0; k < Lanes::kLeaves; ++k) pass.load[k] = problems[k].load->data();
  std::vector<Squares> squares((network_.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, network_.group_count(), [&](int block, int begin, int end) {
    for (int g = begin; g < end; ++g) {
      for (int l = 0; l < kLanes; ++l) {
        const System& system = *problems[Lanes::leaf(l)].system;
        const int row = Lanes::index(g, l), v = network_.vertices()[row];
        const bool free = row < network_.vertex_count() && !system.pinned()[v];
        inertia_[g].lanes[l] = free ? 4.0 / (dt_ * dt_) * system.masses()[v] : 0.0;
        weight_[g].lanes[l] = free ? 1.0 / inertia_[g].lanes[l] : 0.0;
      }
    }
    run(pass, begin, end, squares[block]);
  });
  Squares sum;
  for (const Squares& s : squares) sum.add(s);
  const Double8 largest =
      larger(larger(Lanes::reduce(sum.momentum), Lanes::reduce(sum.load)), Lanes::reduce(sum.inertia));
  return {{simd::sqrt(largest)}, {kRoundOff * simd::sqrt(Lanes::reduce(sum.position))}};
}

template <class Network>
typename ChebyshevMidpoint<Network>::Spectrum ChebyshevMidpoint<Network>::spectrum(Crew& crew) const {
  Double8 high{};
  for (std::size_t g = 0; g < weight_.size(); ++g)
    high = larger(high, 2.0 * weight_[g].lanes * (kFlat * stretch_sum_[g].lanes + damping_sum_[g].lanes));
  high = largest_of_leaf<Lanes>(high);
  const Mask8 estimated = high < kEstimate;
  if (none(~estimated)) return {{}, {high}};
  std::vector<Bounds> bounds((network_.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, network_.group_count(), [&](int block, int begin, int end) {
    run(start_pass(network_, dt_, weight_, start_, nullptr), begin, end, bounds[block]);
  });
  Bounds all;
  for (const Bounds& b : bounds) all = {larger(all.low, b.low), larger(all.high, b.high)};
  return {{estimated ? Double8{} : largest_of_leaf<Lanes>(all.low)},
          {estimated ? high : largest_of_leaf<Lanes>(all.high)}};
}

template <class Network>
void ChebyshevMidpoint<Network>::take_off_damping(Crew& crew) {
  for_blocks(crew, network_.group_count(), [&](int, int begin, int end) {
    run(start_pass(network_, dt_, weight_, start_, constant_.data()), begin, end);
  });
}

// Moves on along p; returns ||R|| where it stood.
template <class Network>
Number8 ChebyshevMidpoint<Network>::pass(Crew& crew, const Number8& alpha, const Number8& beta) {
  const IterationPass<Lanes> pass{.slot_begin = network_.slot_begin(),
                                  .neighbours = network_.neighbours(),
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
  std::vector<Number8> squares((network_.group_count() + kGroups - 1) / kGroups);
  for_blocks(crew, network_.group_count(),
             [&](int block, int begin, int end) { run(pass, begin, end, squares[block]); });
  std::swap(u_, u_next_);
  Double8 sum{};
  for (const Number8& s : squares) sum += s.lanes;
  return {simd::sqrt(Lanes::reduce(sum))};
}

// Takes the points before the last move over for the leaves of the lanes.
template <class Network>
void ChebyshevMidpoint<Network>::settle(const Mask8& lanes) {
  for (int g = 0; g < network_.group_count(); ++g) {
    const Point8 now = Lanes::own(u_next_.data(), g), before = Lanes::own(settled_.data(), g);
    Lanes::store(settled_.data(), g,
                 {lanes ? now.x : before.x, lanes ? now.y : before.y, lanes ? now.z : before.z});
  }
}

template <std::size_t kLeaves>
static std::array<ChebyshevReport, kLeaves> reports(const Mask8& arrived, const Double8& passes,
                                                    const Double8& residual, const Double8& scale) {
  std::array<ChebyshevReport, kLeaves> result;
  for (std::size_t k = 0; k < kLeaves; ++k)
    result[k] = {arrived[k] != 0, static_cast<int>(passes[k]), residual[k], scale[k]};
  return result;
}

template <class Network>
typename ChebyshevMidpoint<Network>::Reports ChebyshevMidpoint<Network>::solve(const Problems& problems,
                                                                               double dt, double tolerance) {
  Crew crew;
  combine(crew, dt);
  const Scales scales = begin(crew, problems);
  const Spectrum spectrum = this->spectrum(crew);
  if (network_.damped()) take_off_damping(crew);
  std::fill(direction_.begin(), direction_.end(), Point8{});

  Semiiteration iteration(spectrum.low.lanes, spectrum.high.lanes);
  Mask8 going = (spectrum.high.lanes <= kLargestHigh) & (spectrum.low.lanes <= kLargestLow), arrived{};
  bool settled = false;  // some leaf has arrived before others
  Double8 residual{}, scale{}, target{}, passes{}, most{};
  while (!none(going)) {
    const Double8 now = pass(crew, iteration.alpha, iteration.beta).lanes;
    residual = going ? now : residual;
    passes = going ? passes + 1.0 : passes;
    if (none(passes > 1.0)) {
      scale = larger(scales.force.lanes, now);
      target = larger(tolerance * scale, (1.0 + spectrum.high.lanes) * scales.round_off.lanes);
      const Double8 rate = iteration.rate();
      for (int l = 0; l < kLanes; ++l)
        most[l] = kMargin + 2.0 * std::max(0.0, std::log(target[l] / now[l]) / std::log(rate[l]));
    }
    const Mask8 there = going & (now <= target);
    going = going & ~there & (now < kInfinity) & (passes <= most);
    arrived = arrived | there;
    settled = settled || (!none(there) && !none(going));
    if (settled && !none(there)) settle(there);
    iteration.advance();
  }
  if (none(arrived)) return reports<Lanes::kLeaves>(arrived, passes, residual, scale);
  if (!settled) settled_.swap(u_next_);
  finish(crew, problems, arrived);
  return reports<Lanes::kLeaves>(arrived, passes, residual, scale);
}

template <class Network>
void ChebyshevMidpoint<Network>::finish(Crew& crew, const Problems& problems, const Mask8& arrived) const {
  FinishPass<Lanes> pass{.vertices = network_.vertices(),
                         .vertex_count = network_.vertex_count(),
                         .dt = dt_,
                         .weight = weight_.data(),
                         .start = start_.data(),
                         .u = settled_.data(),
                         .v0 = data_of<const double>(problems, &MotionState::velocities),
                         .a0 = data_of<const double>(problems, &MotionState::accelerations),
                         .x = data_of<double>(problems, &MotionState::positions),
                         .v = data_of<double>(problems, &MotionState::velocities),
                         .a = data_of<double>(problems, &MotionState::accelerations),
                         .jerk = data_of<double>(problems, &MotionState::jerks)};
  for (int k = 0; k < Lanes::kLeaves; ++k) {
    if (!arrived[k]) pass.x[k] = pass.v[k] = pass.a[k] = pass.jerk[k] = nullptr;
  }
  for_blocks(crew, network_.group_count(), [&](int, int begin, int end) { run(pass, begin, end); });
}

template class ChebyshevMidpoint<SpringNetwork>;
template class ChebyshevMidpoint<LeafSprings>;

}  // namespace wilt::detail
