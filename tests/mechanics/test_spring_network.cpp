// All edge forces in one pass, and the iteration without a matrix that lives on it.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/edge_rows.hpp"
#include "wilt/mechanics/spring_network.hpp"

namespace wilt {
namespace {

using Eigen::VectorXd;

// The paper's forces on a sheet: springs, damping, one-sided swelling, a load; one corner held.
struct PaperSheet {
  test::Sheet shape;
  std::unique_ptr<System> system;
  OneSidedSwelling* swelling = nullptr;
  MotionState state;
};

PaperSheet paper_sheet(int cells, double stiffness, double swelling) {
  PaperSheet result;
  result.shape = test::sheet(cells, 8.0, 0.05, 3);
  const Edges& edges = result.shape.edges;
  const int n = static_cast<int>(result.shape.positions.rows()), e = static_cast<int>(edges.rows());
  Random random(11, "paper sheet");
  std::vector<char> pinned(n, 0);
  pinned[0] = pinned[1] = pinned[cells + 1] = 1;
  result.system = std::make_unique<System>(test::random_values(n, 0.7, 1.5, random), pinned);
  const VectorXd rest = test::lengths(edges, result.shape.positions);
  result.system->add_energy("elastic",
                            std::make_unique<Springs>(edges, rest, VectorXd::Constant(e, stiffness)));
  result.system->add_force("damping", std::make_unique<EdgeDamping>(edges, VectorXd::Constant(e, 0.1)));
  Eigen::MatrixX2d push(e, 2);
  for (int k = 0; k < e; ++k) {
    for (int side = 0; side < 2; ++side) push(k, side) = swelling * rest[k] * random.uniform(0.0, 1.0);
  }
  result.swelling = &result.system->add_force("swelling", std::make_unique<OneSidedSwelling>(edges, push));
  Points3 load = Points3::Zero(n, 3);
  load.bottomRows(cells).col(2).setConstant(0.05);
  result.system->add_force("external", std::make_unique<NodalForce>(load));
  result.state.positions = result.shape.positions;
  return result;
}

// A force that is nothing: with it a system is not springs and loads alone, and Newton's method solves it.
class NoForce : public Force {
 public:
  void add_force(const Points3&, const Points3&, Points3&) const override {}
  void add_jacobian(const Points3&, const Points3&, BlockMatrix&, double, double, Curvature) const override {}
};

// Oracle: the list of edges; 37 vertices do not fill their last group, one vertex has no edge at all.
TEST(EdgeRows, HoldEveryEndOfEveryEdgeOnce) {
  const test::Sheet sheet = test::sheet(5, 1.0, 0.0, 2);
  const detail::EdgeRows rows(37, sheet.edges);
  EXPECT_EQ(rows.row_count(), 40);
  std::map<int, int> seen;
  for (int g = 0; g < rows.group_count(); ++g) {
    for (int s = 8 * rows.group_begin[g]; s < 8 * rows.group_begin[g + 1]; ++s) {
      const int row = 8 * g + s % 8;
      if (rows.ends[s] < 0) {
        EXPECT_EQ(rows.neighbours[s], row);
        continue;
      }
      const int edge = rows.ends[s] / 2, side = rows.ends[s] % 2;
      ++seen[rows.ends[s]];
      EXPECT_EQ(sheet.edges(edge, side), rows.vertices[row]);
      EXPECT_EQ(sheet.edges(edge, 1 - side), rows.vertices[rows.neighbours[s]]);
    }
  }
  EXPECT_EQ(static_cast<int>(seen.size()), sheet.edges.size());
  for (const auto& [end, count] : seen) EXPECT_EQ(count, 1);
  for (int v = 0; v < 37; ++v) EXPECT_EQ(rows.vertices[rows.rows[v]], v);
}

// Oracle: differential; the sum of the terms, edge by edge.
TEST(SpringNetwork, IsTheSumOfItsTerms) {
  const test::Sheet sheet = test::sheet(9, 8.0, 0.3, 4);
  const int e = static_cast<int>(sheet.edges.rows()), n = static_cast<int>(sheet.positions.rows());
  Random random(5, "network");
  const Springs springs(sheet.edges, test::random_values(e, 0.5, 1.5, random),
                        test::random_values(e, 1.0, 5.0, random));
  const LineTension tension(sheet.edges, test::random_values(e, -1.0, 1.0, random));
  const EdgeDamping damping(sheet.edges, test::random_values(e, 0.0, 1.0, random));
  Eigen::MatrixX2d push(e, 2);
  push << test::random_values(e, -1.0, 1.0, random), test::random_values(e, -1.0, 1.0, random);
  const OneSidedSwelling swelling(sheet.edges, push);
  const Points3 v = test::random_points(n, 2.0, random);

  Points3 expected = Points3::Zero(n, 3);
  springs.add_gradient(sheet.positions, expected);
  tension.add_gradient(sheet.positions, expected);
  expected = -expected;
  damping.add_force(sheet.positions, v, expected);
  swelling.add_force(sheet.positions, v, expected);

  EdgeLaw law;
  for (const EdgeLaw::Part part : {EdgeLaw::Part::stiffness, EdgeLaw::Part::push}) {
    law.set_zero(e, part);
    for (const Term* term : {static_cast<const Term*>(&springs), static_cast<const Term*>(&tension),
                             static_cast<const Term*>(&damping), static_cast<const Term*>(&swelling)})
      EXPECT_TRUE(term->add_edge_law(law, part));
  }
  law.revisions = {0, 0};
  SpringNetwork network(n, sheet.edges);
  network.set_law(law);
  Points3 force = Points3::Zero(n, 3);
  network.add_force(sheet.positions, v, force);
  EXPECT_LT((force - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(SpringNetwork, RefusesALawOfOtherEdges) {
  const test::Sheet sheet = test::sheet(3, 1.0, 0.0, 4);
  SpringNetwork network(16, sheet.edges);
  for (const EdgeLaw::Part part : {EdgeLaw::Part::stiffness, EdgeLaw::Part::push}) {
    EdgeLaw law;
    law.set_zero(static_cast<int>(sheet.edges.rows()) - 1, part);
    law.revisions[static_cast<int>(part)] = 0;
    EXPECT_THROW(network.set_law(law), Error);
  }
}

// Oracle: definition; what a setter changes is felt by the next force, and a second set of edges stays apart.
TEST(System, ForcesFollowTheTermsCoefficients) {
  PaperSheet sheet = paper_sheet(4, 4.0, 0.2);
  const Points3 v = Points3::Zero(25, 3);
  const Points3 stretched = 1.1 * sheet.state.positions;
  const auto separate = [&] {
    Points3 sum = Points3::Zero(25, 3);
    for (const char* name : {"elastic", "damping", "swelling", "external"})
      sum += sheet.system->force_of(name, stretched, v);
    return sum;
  };
  Points3 force;
  sheet.system->total_force(stretched, v, force);
  EXPECT_LT((force - separate()).norm(), 1e-13 * force.norm());
  EXPECT_TRUE(sheet.system->only_springs_and_loads());

  const Points3 before = force;
  sheet.swelling->set_coefficients(Eigen::MatrixX2d::Constant(sheet.shape.edges.rows(), 2, 0.7));
  sheet.system->total_force(stretched, v, force);
  EXPECT_LT((force - separate()).norm(), 1e-13 * force.norm());
  EXPECT_GT((force - before).norm(), 0.1 * force.norm());

  Edges one(1, 2);
  one << 0, 24;
  sheet.system->add_energy("tie", std::make_unique<Springs>(one, VectorXd::Ones(1), VectorXd::Ones(1)));
  const Points3 tied = separate() + sheet.system->force_of("tie", stretched, v);
  sheet.system->total_force(stretched, v, force);
  EXPECT_LT((force - tied).norm(), 1e-13 * force.norm());
  EXPECT_FALSE(sheet.system->only_springs_and_loads());
}

// Oracle: differential; the trajectory of Newton's method, for soft springs, whose spectrum is estimated, and
// for stiff ones, whose spectrum is bounded.
TEST(ChebyshevMidpoint, GoesWhereNewtonGoes) {
  for (const double stiffness : {4.0, 1000.0}) {
    PaperSheet fast = paper_sheet(14, stiffness, -0.3), slow = paper_sheet(14, stiffness, -0.3);
    slow.system->add_force("nothing", std::make_unique<NoForce>());
    ImplicitMidpoint chebyshev(*fast.system, {.tolerance = 1e-11}),
        newton(*slow.system, {.tolerance = 1e-11});
    for (int k = 0; k < 30; ++k) {
      const StepReport a = chebyshev.step(fast.state, 0.1), b = newton.step(slow.state, 0.1);
      ASSERT_TRUE(a.converged && b.converged) << a.reason << b.reason;
      ASSERT_EQ(a.newton, 0);
      ASSERT_GT(b.newton, 0);
    }
    const double moved = (slow.state.positions - slow.shape.positions).norm();
    EXPECT_GT(moved, 0.1);
    EXPECT_LT((fast.state.positions - slow.state.positions).norm(), 1e-8 * moved) << "k = " << stiffness;
  }
}

// Oracle: theory; dt^2 k / m of the paper's springs gains a factor of twenty and more in a pass.
TEST(ChebyshevMidpoint, NeedsFewPassesForThePapersSprings) {
  PaperSheet sheet = paper_sheet(20, 4.0, 0.3);
  ImplicitMidpoint stepper(*sheet.system);
  for (int k = 0; k < 20; ++k) {
    const StepReport report = stepper.step(sheet.state, 0.1);
    ASSERT_TRUE(report.converged);
    EXPECT_LE(report.residual, 1e-8);
    EXPECT_LE(report.linear, k == 0 ? 9 : 7) << "step " << k;
  }
}

// Oracle: planted; springs under a pressure that makes the system indefinite are left to Newton's method.
TEST(ChebyshevMidpoint, LeavesCompressedStiffSpringsToNewton) {
  PaperSheet sheet = paper_sheet(8, 1000.0, 2000.0);
  ImplicitMidpoint stepper(*sheet.system);
  MotionState state = sheet.state;
  const StepReport report = stepper.step(state, 0.1);
  EXPECT_GT(report.newton, 0);
  EXPECT_EQ(report.converged, (state.positions - sheet.state.positions).norm() > 0.0);
}

// Oracle: differential; bytes on one, two and three threads, on a sheet of several blocks.
TEST(ChebyshevMidpoint, GivesTheSameBytesOnAnyNumberOfThreads) {
  Points3 result[3];
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    PaperSheet sheet = paper_sheet(60, 4.0, 0.3);
    ImplicitMidpoint stepper(*sheet.system);
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(stepper.step(sheet.state, 0.1).converged);
    result[threads - 1] = sheet.state.positions;
  }
  for (int k = 1; k < 3; ++k)
    EXPECT_EQ(std::memcmp(result[0].data(), result[k].data(), sizeof(double) * result[0].size()), 0);
}

}  // namespace
}  // namespace wilt
