#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>

#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/water/permeation.hpp"

namespace wilt {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Tissue {
  Edges edges;
  VectorXd rest_lengths, dry, water, loss;
};

// A grid of side x side cells with random lengths, masses and water.
Tissue tissue(int side, std::uint64_t seed) {
  Random random(seed, "tissue");
  Tissue t;
  t.edges.resize(2 * side * (side - 1), 2);
  int e = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      if (i + 1 < side) t.edges.row(e++) << j * side + i, j * side + i + 1;
      if (j + 1 < side) t.edges.row(e++) << j * side + i, j * side + i + side;
    }
  }
  const int n = side * side;
  t.rest_lengths.resize(e);
  t.dry.resize(n);
  t.water.resize(n);
  for (int k = 0; k < e; ++k) t.rest_lengths[k] = random.uniform(0.1, 0.3);
  for (int i = 0; i < n; ++i) {
    t.dry[i] = random.uniform(0.1, 0.4);
    t.water[i] = random.uniform(0.2, 1.2);
  }
  t.loss = VectorXd::Zero(n);
  return t;
}

double spread(const Tissue& t) {
  const VectorXd u = t.water.cwiseQuotient(t.dry);
  return std::sqrt((u.array() - u.mean()).square().mean());
}

// Oracle: conservation; round-off of 100 sums over 900 cells, far below 1e-12. The tolerance of the solver
// does not enter, so a loose one must do as well.
TEST(Permeation, KeepsTheTotalWhenNothingIsLost) {
  for (const double tolerance : {1e-13, 1e-3}) {
    Tissue t = tissue(30, 1);
    Permeation permeation(900, t.edges, t.rest_lengths, {.tolerance = tolerance});
    const double before = t.water.sum();
    for (int k = 0; k < 100; ++k) {
      const WaterReport report = permeation.step(t.dry, t.water, t.loss, 0.1);
      ASSERT_TRUE(report.converged);
      ASSERT_EQ(report.dry_cells, 0);
    }
    EXPECT_NEAR(t.water.sum() / before, 1.0, 1e-12);
  }
}

// Oracle: the operator's null space: equal w/b is at rest and everything else goes there.
TEST(Permeation, EvensOutWaterPerDryMass) {
  Tissue t = tissue(12, 2);
  Permeation permeation(144, t.edges, t.rest_lengths);
  double last = spread(t);
  const double first = last;
  for (int k = 0; k < 300; ++k) {
    permeation.step(t.dry, t.water, t.loss, 10.0);
    ASSERT_LE(spread(t), last + 1e-12 * first) << "step " << k;  // round-off of the first spread
    last = spread(t);
  }
  EXPECT_LT(last, 1e-6 * first);

  Tissue even = tissue(12, 3);
  even.water = 4.0 * even.dry;
  const VectorXd before = even.water;
  permeation.step(even.dry, even.water, even.loss, 0.1);
  EXPECT_LT((even.water - before).cwiseAbs().maxCoeff(), 1e-13);
}

// Oracle: analytic. Two cells, b_i u_i' + dt g (u_i' - u_j') = w_i, so the difference of u shrinks by
// 1/(1 + dt g (1/b_0 + 1/b_1)); E is the one edge's length.
TEST(Permeation, TwoCellsExchangeAsTheFormulaSays) {
  const Edges edges = (Edges(1, 2) << 0, 1).finished();
  const double length = 0.25, lambda = 0.1, dt = 0.1;
  VectorXd dry(2), water(2);
  dry << 0.2, 0.3;
  water << 0.9, 0.5;
  const double g = 2.0 * lambda * dry[0] * dry[1] / (length * length * (dry.sum() + water.sum()));
  const double u0 = water[0] / dry[0], u1 = water[1] / dry[1];
  const double difference = (u0 - u1) / (1.0 + dt * g * (1.0 / dry[0] + 1.0 / dry[1]));
  const double flow = dt * g * difference;
  Permeation permeation(2, edges, VectorXd::Constant(1, length), {.lambda = lambda});
  permeation.step(dry, water, VectorXd::Zero(2), dt);
  EXPECT_NEAR(water[0], 0.9 - flow, 1e-13);
  EXPECT_NEAR(water[1], 0.5 + flow, 1e-13);
}

// Oracle: the formula by hand.
TEST(Permeation, PrintedNumberIsTheShareThatGoesInAStep) {
  Edges edge(1, 2);
  edge << 0, 1;
  const Permeation permeation(2, edge, Eigen::VectorXd::Constant(1, 0.5));
  const Eigen::Vector2d dry(0.2, 0.3), water(0.8, 0.6);
  // Masses 1.0 and 0.9, E = l = 0.5: dt u_i (2/E) lambda b_j / (l (m_i + m_j)).
  const double first = 0.1 * 4.0 * 4.0 * 0.1 * 0.3 / (0.5 * 1.9),
               second = 0.1 * 2.0 * 4.0 * 0.1 * 0.2 / (0.5 * 1.9);
  EXPECT_NEAR(permeation.printed_number(dry, water, 0.1), 0.5 * (first + second), 1e-15);
}

// Oracle: differential; equation 1 written out as a dense matrix in w and solved directly.
TEST(Permeation, SolvesThePrintedOperatorAsALinearSystem) {
  Tissue t = tissue(6, 4);
  t.loss = 0.05 * t.water;
  const double dt = 0.3, lambda = 0.1;
  const VectorXd m = t.dry + t.water;
  MatrixXd system = MatrixXd::Identity(36, 36);
  const double mean_sum = 2.0 * t.rest_lengths.sum() / 36.0;
  for (int e = 0; e < t.edges.rows(); ++e) {
    for (const auto& [i, j] :
         {std::pair(t.edges(e, 0), t.edges(e, 1)), std::pair(t.edges(e, 1), t.edges(e, 0))}) {
      const double c = dt * 2.0 / mean_sum * lambda / (t.rest_lengths[e] * (m[i] + m[j]));
      system(i, j) -= c * t.dry[i];
      system(i, i) += c * t.dry[j];
    }
  }
  const VectorXd expected = system.partialPivLu().solve(t.water - dt * t.loss);
  Permeation(36, t.edges, t.rest_lengths).step(t.dry, t.water, t.loss, dt);
  EXPECT_LT((t.water - expected).cwiseAbs().maxCoeff(), 1e-11);  // the solver's 1e-13 times u <= 12 and slack
}

// Oracle: conservation: what left is what was asked for less what the bound withheld, and is the difference.
TEST(Permeation, CountsEveryDropAlsoWhereCellsRunDry) {
  Tissue t = tissue(10, 5);
  t.loss.setConstant(0.05);
  t.loss[17] = 3.0;
  t.water[40] = 2e-3;
  Permeation permeation(100, t.edges, t.rest_lengths);
  double withheld = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double before = t.water.sum();
    const WaterReport report = permeation.step(t.dry, t.water, t.loss, 0.1);
    EXPECT_NEAR(before - t.water.sum(), report.lost, 1e-13 * before);
    EXPECT_NEAR(report.lost + report.withheld, 0.1 * t.loss.sum(), 1e-13);
    EXPECT_GE(t.water.minCoeff(), 1e-3);
    withheld += report.withheld;
  }
  EXPECT_GT(withheld, 0.0);
}

// Oracle: analytic; w' = (w - loss dt)/(1 - dt L_i), each cell with its own E.
TEST(Permeation, PrintedFormDividesEachCell) {
  const Edges edges = (Edges(2, 2) << 0, 1, 1, 2).finished();
  VectorXd lengths(2), dry(3), water(3), loss(3);
  lengths << 0.2, 0.4;
  dry << 0.2, 0.2, 0.3;
  water << 0.8, 0.6, 0.9;
  loss << 0.01, 0.02, 0.03;
  const double flow = 0.1 * (0.2 * 0.6 - 0.2 * 0.8) / (0.2 * 1.8);  // into cell 0
  const double laplacian0 = 2.0 / 0.2 * flow;
  const double expected = (0.8 - 0.001) / (1.0 - 0.1 * laplacian0);
  Permeation permeation(3, edges, lengths);
  const double before = water.sum();
  const WaterReport report = permeation.printed_step(dry, water, loss, 0.1);
  EXPECT_NEAR(water[0], expected, 1e-15);
  EXPECT_NEAR(report.lost, before - water.sum(), 1e-15);
}

// Oracle: differential, the same call twice.
TEST(Permeation, GivesTheSameBytesAgain) {
  Tissue a = tissue(40, 6), b = tissue(40, 6);
  Permeation pa(1600, a.edges, a.rest_lengths), pb(1600, b.edges, b.rest_lengths);
  for (int k = 0; k < 3; ++k) {
    pa.step(a.dry, a.water, a.loss, 0.1);
    pb.step(b.dry, b.water, b.loss, 0.1);
  }
  EXPECT_EQ(std::memcmp(a.water.data(), b.water.data(), sizeof(double) * 1600), 0);
}

// Oracle: negative; the water is untouched after a refusal.
TEST(Permeation, RefusesBadInput) {
  const Edges edges = (Edges(1, 2) << 0, 1).finished(), outside = (Edges(1, 2) << 0, 2).finished();
  EXPECT_THROW(Permeation(2, outside, VectorXd::Ones(1)), Error);
  EXPECT_THROW(Permeation(2, edges, VectorXd::Zero(1)), Error);
  EXPECT_THROW(Permeation(2, edges, VectorXd::Ones(2)), Error);
  EXPECT_THROW(Permeation(2, edges, VectorXd::Ones(1), {.lambda = -1.0}), Error);
  Permeation permeation(2, edges, VectorXd::Ones(1));
  VectorXd water = VectorXd::Ones(2);
  EXPECT_THROW(permeation.step(VectorXd::Zero(2), water, VectorXd::Zero(2), 0.1), Error);
  EXPECT_THROW(permeation.step(VectorXd::Ones(2), water, VectorXd::Constant(2, NAN), 0.1), Error);
  EXPECT_EQ(water, VectorXd::Ones(2));
}

}  // namespace
}  // namespace wilt
