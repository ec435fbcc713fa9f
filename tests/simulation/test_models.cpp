// Both models as a whole: what must hold whatever the figures.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "simulation/case.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/drying_fields.hpp"
#include "wilt/simulation/regions.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

SimulationResult run(const Case& c) {
  return simulate(c.leaf, c.venation, c.config);
}

class EveryModel : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Models, EveryModel, testing::ValuesIn(model_names()));

// Oracle: at rest every spring, hinge and pressure is in balance.
TEST_P(EveryModel, DoesNotMoveWithoutWaterLossExternalForceAndGravity) {
  Case c = make_case("ivy", GetParam());
  c.config.water.loss_rate = 0.0;
  c.config.external.scale = 0.0;
  c.config.gravity.strength = 0.0;
  const SimulationResult result = run(c);
  EXPECT_TRUE(result.completed) << result.stop_reason;
  EXPECT_LT((result.frames.back().positions - c.leaf.positions).cwiseAbs().maxCoeff(),
            1e-9 * leaf_length(c.leaf));
}

// Oracle: the bytes of the run on one thread.
TEST_P(EveryModel, GivesTheSameBytesOnAnyNumberOfThreads) {
  const Case c = make_case("maple", GetParam(), 1500);
  std::string one;
  {
    const ThreadLimit limit(1);
    one = run(c).positions_hash;
  }
  for (const int threads : {2, 3}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(run(c).positions_hash, one);
  }
}

// Oracle: the same leaf twice as large and turned gives the same metrics, to the round-off that 20 steps
// amplify.
TEST_P(EveryModel, IsInvariantToScale) {
  const Case small = make_case("grape", GetParam());
  Case large = small;
  large.leaf.positions *= 2.0;
  large.leaf.stalk.centreline *= 2.0;
  for (double& radius : large.leaf.stalk.radii) radius *= 2.0;
  large.venation = find_venation(large.leaf, species("grape").secondary, venation_options(large.config));
  const FrameMetrics a = run(small).metrics.back(), b = run(large).metrics.back();
  EXPECT_NEAR(a.wrinkle, b.wrinkle, 1e-6);
  EXPECT_NEAR(a.curl, b.curl, 1e-5);
  EXPECT_NEAR(a.area_ratio, b.area_ratio, 1e-6);
}

// Oracle: a run of numbers in another order; positions are compared vertex by vertex.
TEST_P(EveryModel, IsInvariantToTheNumberingOfTheVertices) {
  const Case c = make_case("ivy", GetParam());
  const int n = c.leaf.mesh.num_vertices();
  const auto renamed = [n](int v) { return static_cast<int>((static_cast<long>(v) * 7919) % n); };
  Case other = c;
  Faces faces = c.leaf.mesh.face_matrix();
  for (int i = 0; i < faces.size(); ++i) faces.data()[i] = renamed(faces.data()[i]);
  for (int v = 0; v < n; ++v) other.leaf.positions.row(renamed(v)) = c.leaf.positions.row(v);
  other.leaf.mesh = SurfaceMesh(n, faces);
  other.leaf.petiole = VertexId(renamed(c.leaf.petiole));
  other.leaf.skin = planar_skin(other.leaf.mesh, other.leaf.positions);
  other.venation = find_venation(other.leaf, species("ivy").secondary, venation_options(other.config));
  const Points3 a = run(c).frames.back().positions, b = run(other).frames.back().positions;
  double worst = 0.0;
  for (int v = 0; v < n; ++v) worst = std::max(worst, (a.row(v) - b.row(renamed(v))).norm());
  EXPECT_LT(worst, 1e-3 * leaf_length(c.leaf));  // approximate distances depend a little on the order
}

// Oracle: a callback that asks to stop at once.
TEST_P(EveryModel, KeepsWhatWasComputedWhenInterrupted) {
  const Case c = make_case("willow", GetParam());
  int asked = 0;
  Monitor monitor;
  monitor.cancelled = [&] { return ++asked > 5; };
  const SimulationResult result = simulate(c.leaf, c.venation, c.config, monitor);
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.completed);
  EXPECT_EQ(result.steps.size(), 5u);
  EXPECT_EQ(result.frames.back().iteration, 5);
}

// Oracle: what the run records of itself, bit by bit, by other functions: frames, metrics, forces by region,
// energies. A free leaf's petiole is laid back on its place; halved steps put the motion elsewhere in memory.
TEST_P(EveryModel, ShowsTheStateThatItRecords) {
  for (const char* pin : {"ring", "free"}) {
    Case c = make_case("ivy", GetParam());
    c.config.pin = pin;
    c.config.frames = c.config.iterations + 1;
    Simulation simulation(c.leaf, c.venation, c.config);
    const VertexData<Region> regions = leaf_regions(c.leaf, c.venation);
    EXPECT_DOUBLE_EQ(simulation.scale() * leaf_length(c.leaf), kWorkingLength);
    for (; !simulation.ended(); simulation.step()) {
      const SimulationResult& recorded = simulation.result();
      const Frame now = simulation.frame();
      EXPECT_EQ(now.iteration, simulation.iteration());
      EXPECT_EQ(now.positions, recorded.frames.back().positions);
      EXPECT_EQ(now.stalk, recorded.frames.back().stalk);
      EXPECT_EQ(now.dryness, recorded.frames.back().dryness);
      EXPECT_EQ(now.water_fraction, recorded.frames.back().water_fraction);
      EXPECT_EQ(simulation.metrics().curl, recorded.metrics.back().curl);
      EXPECT_EQ(simulation.metrics().wrinkle, recorded.metrics.back().wrinkle);
      const MotionState& motion = simulation.motion();
      const auto rows = force_rows(regions, simulation.model(), motion.positions, motion.velocities,
                                   simulation.iteration());
      EXPECT_EQ(rows.back().elastic, recorded.forces.back().elastic);
      EXPECT_EQ(rows.back().pressure, recorded.forces.back().pressure);
      if (simulation.iteration() > 0) {
        EXPECT_EQ(simulation.model().water().sum(), recorded.steps.back().water);
      }
    }
  }
}

// Oracle: the run that goes on to its end and the one that ends there.
TEST_P(EveryModel, GivesItsResultAndGoesOn) {
  const Case c = make_case("poplar", GetParam());
  Simulation simulation(c.leaf, c.venation, c.config);
  for (int k = 0; k < 7; ++k) simulation.step();
  const SimulationResult early = simulation.finish();
  EXPECT_EQ(early.frames.back().iteration, 7);
  EXPECT_EQ(early.metrics.back().iteration, 7);
  EXPECT_EQ(early.frames.size(), 2u);
  EXPECT_EQ(simulation.result().frames.size(), 1u);
  while (!simulation.ended()) simulation.step();
  const SimulationResult whole = run(c);
  EXPECT_EQ(simulation.finish().positions_hash, whole.positions_hash);
  EXPECT_EQ(std::move(simulation).finish().positions_hash, whole.positions_hash);
}

// Oracle: planted; the mesh on which the printed form fails.
TEST(PaperModel, SaysWhenTheMeshIsTooFineForThePrintedPermeation) {
  EXPECT_TRUE(run(make_case("willow", "paper")).note.empty());
  Case fine = make_case("willow", "paper", 5000);
  fine.config.iterations = 40;  // as printed it stops at 36
  const SimulationResult result = run(fine);
  EXPECT_NE(result.note.find("printed permeation"), std::string::npos);
  EXPECT_TRUE(result.completed) << result.stop_reason;
}

// Oracle: conservation of momentum and angular momentum, on a free leaf without external force or gravity.
TEST(CellModel, HasNoNetInternalForceOrTorque) {
  Case c = make_case("maple", "cell");
  c.config.external.scale = 0.0;
  c.config.gravity.strength = 0.0;
  c.config.pin = "free";
  const double scale = kWorkingLength / leaf_length(c.leaf);
  const ModelInput input{c.leaf, c.venation, c.config, scale, scale * c.leaf.positions};
  const auto model = make_model(input);
  Points3 x = input.rest;
  for (int v = 0; v < x.rows(); ++v) x(v, 2) += 0.1 * std::sin(3.0 * x(v, 0)) * std::cos(2.0 * x(v, 1));
  for (int step = 0; step < 50; ++step) model->advance(0.1, x);
  const Points3 velocity = 0.1 * x;
  Points3 force = Points3::Zero(x.rows(), 3);
  model->system().total_force(x, velocity, force);
  Vec3 net = Vec3::Zero(), torque = Vec3::Zero();
  for (int v = 0; v < x.rows(); ++v) {
    net += force.row(v).transpose();
    torque += Vec3(x.row(v).transpose()).cross(Vec3(force.row(v).transpose()));
  }
  const double size = force.rowwise().norm().sum();
  EXPECT_GT(size, 1.0);
  EXPECT_LT(net.norm(), 1e-13 * size);  // round-off of the sum
  EXPECT_LT(torque.norm(), 1e-13 * size * kWorkingLength);
}

// Oracle: the totals that the steps report, with nothing lost.
TEST(CellModel, ConservesWaterWhenNothingIsLost) {
  Case c = make_case("poplar", "cell");
  c.config.water.loss_rate = 0.0;
  c.config.iterations = 100;
  const SimulationResult result = run(c);
  EXPECT_NEAR(result.steps.back().water / result.steps.front().water, 1.0, 1e-12);
}

// Oracle: the rate from the table and the vapour pressure deficit; dry cells would break the sum, so the run
// is short.
TEST(CellModel, LosesWaterAtTheRateOfTheAir) {
  for (const double humidity : {0.2, 0.5, 1.0}) {
    Case c = make_case("poplar", "cell");
    c.config.water.humidity = humidity;
    const SimulationResult result = run(c);
    const double before = result.steps.front().water, after = result.steps.back().water;
    const double expected = 120.0 * 0.02 * (1.0 - humidity) / 0.5 * 0.1 * (result.steps.size() - 1);
    EXPECT_NEAR(before - after, expected, 1e-9 * before) << humidity;
  }
}

// Oracle: mesh refinement; the normalised model keeps its large-scale figures.
TEST(CellModel, HardlyDependsOnTheResolution) {
  std::vector<double> curls;
  for (const int vertices : {500, 1000, 2000}) {
    Case c = make_case("poplar", "cell", vertices);
    c.config.iterations = 100;
    c.config.shrinkage.noise = 0.0;
    curls.push_back(run(c).metrics.back().curl);
  }
  EXPECT_NEAR(curls[0], curls[2], 0.25 * curls[2]);  // band: what buckling into another shape may change
  EXPECT_NEAR(curls[1], curls[2], 0.25 * curls[2]);
}

// Oracle: the sign of the curvature, against the same leaf without any; nothing else bends it.
TEST(CellModel, RollsTheMarginTheWayItsCurvaturePoints) {
  Case c = make_case("poplar", "cell", 600);
  c.config.iterations = 100;
  c.config.external.scale = c.config.gravity.strength = c.config.shrinkage.amount = 0.0;
  c.config.curvature.tip = c.config.curvature.panel = 0.0;
  const auto margin_height = [&](double roll) {
    c.config.curvature.roll = roll;
    const Points3 x = run(c).frames.back().positions;
    const std::vector<VertexId>& rim = margin_loop(c.leaf.mesh, c.leaf.positions);
    double sum = 0.0;
    for (const VertexId v : rim) sum += x.row(v).z();
    return sum / static_cast<double>(rim.size()) / leaf_length(c.leaf);
  };
  const double flat = margin_height(0.0);
  EXPECT_GT(margin_height(60.0), flat + 0.01);
  EXPECT_LT(margin_height(-60.0), flat - 0.01);
}

// Oracle: mesh refinement; the mean of the fields over the blade belongs to the leaf, not to its mesh. Band:
// tensors are means over the faces around a vertex, which blur them by an edge.
TEST(DryingFields, BelongToTheLeafAndNotToItsMesh) {
  const auto means = [](int vertices) {
    const Case c = make_case("tilia", "cell", vertices);
    const double scale = kWorkingLength / leaf_length(c.leaf);
    const DryingFields fields =
        drying_fields({c.leaf, c.venation, c.config, scale, scale * c.leaf.positions});
    const VertexData<double> areas = vertex_areas(c.leaf.mesh, c.leaf.positions);
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (const VertexId v : c.leaf.mesh.vertices())
      sum += areas[v] *
             Eigen::Vector4d(1.0, fields.curvature[v].norm(), fields.grain[v].norm(), fields.folds[v].norm());
    return Eigen::Vector3d(sum.tail<3>() / sum[0]);
  };
  const Eigen::Vector3d coarse = means(1000), fine = means(4000);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(coarse[k], fine[k], 0.05 * fine[k]) << k;
}

// Oracle: without gravity's loss of turgor the stalk stays as drawn; with it the blade's far end sinks.
TEST(CellModel, DroopsAsTheTurgorGoes) {
  Case c = make_case("tilia", "cell");
  c.config.iterations = 100;
  c.config.external.scale = 0.0;
  c.config.gravity.petiole_turgor_loss = 0.0;
  const SimulationResult stiff = run(c);
  c.config.gravity.petiole_turgor_loss = 0.9;
  const SimulationResult limp = run(c);
  const double drop_stiff =
      stiff.frames.back().positions.col(2).mean() - stiff.frames[0].positions.col(2).mean();
  const double drop_limp =
      limp.frames.back().positions.col(2).mean() - limp.frames[0].positions.col(2).mean();
  EXPECT_LT(drop_limp, drop_stiff - 0.1 * leaf_length(c.leaf));
  // The stem end of the stalk is clamped.
  const int last = static_cast<int>(c.leaf.stalk.centreline.rows()) - 1;
  EXPECT_LT((limp.frames.back().stalk.row(last) - c.leaf.stalk.centreline.row(last)).norm(), 1e-9);
}

}  // namespace
}  // namespace wilt
