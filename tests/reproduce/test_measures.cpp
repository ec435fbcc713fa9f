// The figures that claims compare, on data whose answer is known.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "wilt/leaf/species.hpp"
#include "wilt/reproduce/measures.hpp"
#include "wilt/simulation/regions.hpp"

namespace wilt {
namespace {

constexpr int kVertices = 300;

// Oracle: Spearman's definition; 0.8 is 1 - 6 * 4 / (5 * 24) for one swap of distance two on five ranks.
TEST(RankCorrelation, IsSpearmans) {
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {0.1, 0.2, 5, 5e9}), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {4, 3, 2, 1}), -1.0);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4, 5}, {1, 2, 4, 5, 3}), 1.0 - 6.0 * 6.0 / (5.0 * 24.0));
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3}, {7, 7, 7}), 0.0);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {1, 2, std::nan("")})));  // a run that broke off
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 2, 2, 4}), 3.0 / std::sqrt(10.0),
              1e-15);  // ties: 4.5/sqrt(5*4.5)
}

// Oracle: curves drawn by hand.
TEST(Waves, AreFallsOfAShareOfTheRange) {
  EXPECT_EQ(count_waves({0, 1, 2, 3, 4}, 0.02), 0);           // rises
  EXPECT_EQ(count_waves({0, 5, 3, 8, 6, 10}, 0.1), 2);        // two waves on the way up
  EXPECT_EQ(count_waves({0, 5, 4.95, 8, 7.95, 10}, 0.1), 0);  // too small
  EXPECT_EQ(count_waves({0, 4, 0}, 0.5), 1);
  EXPECT_EQ(count_waves({1, 1, 1}, 0.02), 0);
  EXPECT_EQ(count_waves({}, 0.02), 0);
}

class OnALeaf : public testing::Test {
 protected:
  Experiments experiments{kVertices, 1, {}};
};

// Oracle: nothing has moved in the petiole's frame, however the leaf as a whole was moved.
TEST_F(OnALeaf, DisplacementLeavesOutRigidMotion) {
  const Subject& subject = experiments.leaf("ivy");
  Frame frame;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  frame.positions =
      (subject.leaf.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(0.3, -0.1, 0.2);
  EXPECT_LT(displacement(subject, frame).maxCoeff(), 1e-12);
  EXPECT_LT(tip_rotation_in_lobe(subject, frame),
            1e-5);  // degrees; acos-free, so round-off over the mean edge
}

// Oracle: the part beyond a height turned by a known angle; the vertices that moved are those beyond it.
TEST_F(OnALeaf, DisplacementAndAreaShareFollowAFold) {
  const Subject& subject = experiments.leaf("willow");
  const double length = leaf_length(subject.leaf), fold = 0.8 * length, angle = 0.5;
  Frame frame;
  frame.positions = subject.leaf.positions;
  for (int v = 0; v < frame.positions.rows(); ++v) {
    const double beyond = subject.leaf.positions(v, 1) - fold;
    if (beyond <= 0.0) continue;
    const double z = subject.leaf.positions(v, 2);
    frame.positions(v, 1) = fold + std::cos(angle) * beyond - std::sin(angle) * z;
    frame.positions(v, 2) = std::sin(angle) * beyond + std::cos(angle) * z;
  }
  const Eigen::VectorXd moved = displacement(subject, frame);
  const VertexId tip = subject.venation.tips.front().vertex;
  const double arm =
      std::hypot(subject.leaf.positions(int(tip), 1) - fold, subject.leaf.positions(int(tip), 2));
  EXPECT_NEAR(moved[tip], 2.0 * std::sin(0.5 * angle) * arm / length, 1e-12);
  const double beyond =
      area_share(subject, [&](VertexId v) { return subject.leaf.positions(int(v), 1) > fold; });
  EXPECT_NEAR(area_share(subject, [&](VertexId v) { return moved[v] > 1e-9; }), beyond, 1e-12);
  EXPECT_GT(beyond, 0.0);
  EXPECT_LT(beyond, 0.2);
}

// Oracle: Table 1's range, and equal masses when the range is a point.
TEST_F(OnALeaf, FirstMassIsInTheUnitsOfTableOne) {
  const Subject& maple = experiments.leaf("maple");
  for (const char* model : {"paper", "cell"}) {
    const Eigen::VectorXd mass = first_mass(maple, experiments.config("maple", model));
    EXPECT_NEAR(mass.maxCoeff(), 1.5, 1e-12) << model;
    EXPECT_GE(mass.minCoeff(), 0.7 - 1e-12) << model;
    const Eigen::VectorXd uniform =
        first_mass(maple, experiments.config("maple", model, {{"mass.min", "1.1"}, {"mass.max", "1.1"}}));
    EXPECT_LT((uniform.array() - 1.1).abs().maxCoeff(), 1e-12) << model;
  }
}

// Oracle: the same object; a run is computed once.
TEST_F(OnALeaf, RunsAreKept) {
  const Overrides still = {{"external.scale", "0"}, {"water.loss_rate", "0"}};
  const Experiment& first = experiments.run("tilia", "paper", still);
  EXPECT_EQ(&first, &experiments.run("tilia", "paper", still));
  EXPECT_NE(&first, &experiments.run("tilia", "paper", {{"external.scale", "0"}}));
  EXPECT_EQ(first.result.frames.size(), std::size_t{Experiments::kFrames});
}

// Oracle: planted; a run that broke off has metrics that compare as false.
TEST_F(OnALeaf, MetricsOfARunThatBrokeOffAreNoNumbers) {
  const Subject& subject = experiments.leaf("tilia");
  Experiment broken{subject, experiments.config("tilia", "paper"), {}};
  broken.result.metrics.push_back({50, 0.1, 1.0});
  EXPECT_EQ(final_metrics(broken).wrinkle, 0.1);
  broken.result.completed = false;
  EXPECT_TRUE(std::isnan(final_metrics(broken).wrinkle));
  EXPECT_TRUE(std::isnan(final_metrics(broken).curl));
}

}  // namespace
}  // namespace wilt
