// What stops a run, and what does not.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "wilt/leaf/species.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/simulation/watchdog.hpp"

namespace wilt {
namespace {

struct Case {
  Leaf leaf = make_leaf("ivy", 400, 1);
  Points3 rest = kWorkingLength / leaf_length(leaf) * leaf.positions;
  Points3 still = Points3::Zero(rest.rows(), 3);
  Eigen::VectorXd masses = Eigen::VectorXd::Ones(rest.rows());
  LeafMetrics metrics{leaf.mesh, rest, leaf.petiole, {}};
  Watchdog watchdog{0.1, 1e-8};
  StepRow row{.iteration = 1, .dt = 0.1, .residual = 1e-8, .water = 100.0};

  std::string complaint() const { return watchdog.complaint(row, metrics.max_strain(rest), still, masses); }
};

// Oracle: planted, one thing at a time.
TEST(Watchdog, NamesWhatIsAmiss) {
  EXPECT_EQ(Case().complaint(), "");
  constexpr double kNotFinite[] = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(), -1.0};
  const std::pair<double StepRow::*, const char*> figures[] = {{&StepRow::kinetic, "the kinetic energy"},
                                                               {&StepRow::elastic, "the elastic energy"},
                                                               {&StepRow::bending, "the bending energy"},
                                                               {&StepRow::water, "the water"}};
  for (const auto& [figure, name] : figures) {
    for (const double value : kNotFinite) {
      Case c;
      c.row.*figure = value;
      EXPECT_NE(c.complaint().find(name), std::string::npos) << name << " " << value;
    }
  }
  Case c;
  c.row.residual = 1.1e-8;
  EXPECT_NE(c.complaint().find("solver.tolerance"), std::string::npos);
}

// Oracle: a leaf that is stretched along one axis has edges along it stretched as much, and none more.
TEST(Watchdog, LetsEdgesStretchToTheLimitAndNoFurther) {
  Case c;
  const Points3 rest = c.rest;
  c.rest.col(0) = (kLargestStretch - 0.01) * rest.col(0);
  EXPECT_EQ(c.complaint(), "");
  c.rest.col(0) = 1.2 * kLargestStretch * rest.col(0);  // no edge lies along x to the last digit
  EXPECT_NE(c.complaint().find("times its rest length"), std::string::npos);
}

// Oracle: kinetic energy of velocities that alternate, of which half a length per step is the limit; and of a
// fall, which is no motion of the leaf in itself.
TEST(Watchdog, LetsALeafFallButNotFlyApart) {
  Case c;
  const auto complaint_at = [&](double each, double all) {
    for (int v = 0; v < c.still.rows(); ++v) c.still.row(v) << 0.0, 0.0, all + (v % 2 == 0 ? each : -each);
    c.row.kinetic = 0.5 * c.masses.dot(c.still.rowwise().squaredNorm());
    return c.complaint();
  };
  const double limit = kLargestMotion * kWorkingLength / 0.1;
  EXPECT_EQ(complaint_at(0.99 * limit, 0.0), "");
  EXPECT_EQ(complaint_at(0.0, 1000.0 * limit), "");
  EXPECT_NE(complaint_at(1.01 * limit, 0.0).find("of its length in one step"), std::string::npos);
}

SimulationResult run(const char* name, const std::vector<std::pair<const char*, const char*>>& settings) {
  const Leaf leaf = make_leaf(name, 300, 1);
  Config config = default_config(species(name));
  for (const auto& [key, value] : settings) set(config, key, value);
  return simulate(leaf, find_venation(leaf, species(name).secondary, venation_options(config)), config);
}

// Oracle: settings under which the printed model tears the leaf apart though every step converges.
TEST(Watchdog, StopsARunAndKeepsWhatWasComputed) {
  const SimulationResult result = run("tilia", {{"model", "paper"}, {"swelling.coefficient", "50"}});
  EXPECT_FALSE(result.completed);
  EXPECT_FALSE(result.interrupted);
  EXPECT_NE(result.stop_reason.find("times its rest length"), std::string::npos) << result.stop_reason;
  for (const StepRow& step : result.steps) EXPECT_TRUE(step.converged) << step.iteration;
  EXPECT_EQ(result.frames.back().iteration, static_cast<int>(result.steps.size()));
  EXPECT_GT(result.steps.size(), 10u);
  EXPECT_TRUE(result.frames.back().positions.allFinite());
}

// Oracle: conservation. The least water that a cell keeps is no more than a leaf begins with.
TEST(Watchdog, NoWaterComesFromNowhereIntoALeafWithHardlyAny) {
  for (const char* model : {"cell", "paper"}) {
    const SimulationResult result = run("grape", {{"model", model},
                                                  {"mass.min", "0.001"},
                                                  {"mass.water_fraction", "0.05"},
                                                  {"water.diffusion", "0"},
                                                  {"water.loss_rate", "0"},
                                                  {"external.scale", "0"},
                                                  {"iterations", "5"}});
    ASSERT_EQ(result.steps.size(), 5u) << result.stop_reason;
    const double first = result.frames.front().water_fraction.minCoeff();
    EXPECT_NEAR(result.frames.back().water_fraction.minCoeff(), first, 1e-9) << model;
    EXPECT_NEAR(result.steps.back().water / result.steps.front().water, 1.0, 1e-12) << model;
  }
}

// Oracle: the meaning of a residual: a converged step has reached its tolerance, also where round-off is all
// that there is to be seen.
TEST(Watchdog, TheResidualOfALeafAtRestIsWithinTheTolerance) {
  const SimulationResult result = run("willow", {{"model", "paper"},
                                                 {"springs.stiffness", "1e6"},
                                                 {"water.loss_rate", "0"},
                                                 {"external.scale", "0"},
                                                 {"solver.tolerance", "1e-12"},
                                                 {"iterations", "5"}});
  EXPECT_TRUE(result.completed) << result.stop_reason;
  for (const StepRow& step : result.steps) EXPECT_LE(step.residual, 1.001e-12) << step.iteration;
}

}  // namespace
}  // namespace wilt
