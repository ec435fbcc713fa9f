// State to pigments to colours: what comes first, where, and that nothing but the state counts.
#include "wilt/simulation/senescence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/random.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt {
namespace {

struct Case {
  Leaf leaf;
  Pigmentation pigments;
  Venation venation;
  SenescencePattern pattern;
};

Case make_case(const std::string& name) {
  Case c{make_leaf(name, 600, 1), species(name).pigments, {}, {}};
  c.venation = find_venation(c.leaf, species(name).secondary);
  c.pattern = senescence_pattern(c.leaf, c.venation, c.pigments);
  return c;
}

class EveryPigmentation : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Species, EveryPigmentation, testing::ValuesIn(species_names()));

// Oracle: the ends that the preset states, and the direction of every pigment between them.
TEST_P(EveryPigmentation, GoesFromItsFreshToItsDeadTissue) {
  const Pigmentation& p = species(GetParam()).pigments;
  const LeafTissue fresh = senescent_tissue(p, {0.0, 1.0, 0.0}), dead = senescent_tissue(p, {1.05, 1.0, 0.0});
  EXPECT_EQ(fresh.chlorophyll, p.chlorophyll);
  EXPECT_EQ(fresh.carotenoids, p.carotenoids);
  EXPECT_EQ(fresh.anthocyanin, 0.0);
  EXPECT_EQ(fresh.brown, 0.0);
  EXPECT_EQ(fresh.structure, p.structure);
  EXPECT_NEAR(dead.chlorophyll, p.chlorophyll_left * p.chlorophyll, 1e-12);
  EXPECT_NEAR(dead.carotenoids, p.carotenoids_left * p.carotenoids, 1e-12);
  EXPECT_NEAR(dead.brown, p.brown, 1e-12);
  EXPECT_NEAR(dead.structure, p.structure_dry, 1e-12);
  LeafTissue before = fresh;
  for (int i = 1; i <= 150; ++i) {
    const LeafTissue now = senescent_tissue(p, {0.01 * i, 1.0, 0.0});
    EXPECT_NO_THROW(now.validate());
    EXPECT_LE(now.chlorophyll, before.chlorophyll);
    EXPECT_LE(now.carotenoids, before.carotenoids);
    EXPECT_GE(now.brown, before.brown);
    EXPECT_LE(now.water, before.water);
    before = now;
  }
}

// Oracle: the order of autumn. Where half the chlorophyll is gone the carotenoids are all there and nothing
// is brown; then the leaf is redder and lighter than fresh; at death it is darker again.
TEST_P(EveryPigmentation, LosesGreenThenYellowThenTurnsBrown) {
  const Pigmentation& p = species(GetParam()).pigments;
  double age = 0.0;
  while (senescent_tissue(p, {age, 0.0, 0.0}).chlorophyll > 0.5 * p.chlorophyll) age += 0.01;
  const LeafTissue half = senescent_tissue(p, {age, 0.0, 0.0});
  EXPECT_EQ(half.carotenoids, p.carotenoids);
  EXPECT_EQ(half.brown, 0.0);
  const auto colour = [&](double a) { return leaf_light(senescent_tissue(p, {a, 0.0, 0.0})).reflectance; };
  const Vec3 fresh = colour(0.0), yellow = colour(0.6), dead = colour(1.05);
  EXPECT_GT(fresh.y(), fresh.x());
  EXPECT_GT(yellow.x(), 2.0 * fresh.x());
  EXPECT_GT(yellow.x(), yellow.y());
  EXPECT_LT(dead.x(), yellow.x());
  // Muted: a dry leaf is less saturated than a yellow one.
  EXPECT_GT(dead.z() / dead.x(), yellow.z() / yellow.x());
}

// Oracle: the pattern's own maps. At one dryness all over, tissue at the margin is older than tissue near the
// main veins, tissue between veins older than tissue on them.
TEST_P(EveryPigmentation, BeginsAtTheMarginAndBetweenTheVeins) {
  const Case c = make_case(GetParam());
  const double length = leaf_length(c.leaf), farthest = c.venation.primary_distance.maxCoeff();
  double margin = 0.0, middle = 0.0, on = 0.0, between = 0.0;
  int margins = 0, middles = 0, ons = 0, betweens = 0;
  for (int v = 0; v < c.leaf.positions.rows(); ++v) {
    const double age = tissue_age(0.6, c.pattern.ahead[v]);
    const double reach = c.venation.primary_distance[v] / farthest;
    if (c.pattern.margin_distance[v] < 1e-9 && reach > 0.5) margin += age, ++margins;
    if (reach < 0.15) middle += age, ++middles;
    if (reach < 0.2 || c.pattern.margin_distance[v] < 0.04 * length) continue;
    if (c.venation.vein_distance[v] < 0.008 * length) on += age, ++ons;
    if (c.venation.vein_distance[v] > 0.03 * length) between += age, ++betweens;
  }
  ASSERT_GT(std::min(margins, middles), 5);
  EXPECT_GT(margin / margins, middle / middles + 0.05);
  if (std::string(GetParam()) == "willow") return;  // too narrow to have tissue away from veins and margin
  ASSERT_GT(std::min(ons, betweens), 5);
  EXPECT_GT(between / betweens, on / ons + 0.02);
}

// Oracle: a fresh leaf is of one colour; another individual ages elsewhere.
TEST(Senescence, IsUniformWhileFreshAndVariesWithTheIndividual) {
  const Case c = make_case("ivy");
  const TissueColours colours(c.pigments);
  const Eigen::VectorXd dryness = Eigen::VectorXd::LinSpaced(c.leaf.positions.rows(), 0.0, 1.0);
  const Points3 fresh = leaf_colours(c.pattern, colours, Eigen::VectorXd::Zero(dryness.size()));
  for (int v = 1; v < fresh.rows(); ++v) EXPECT_LT((fresh.row(v) - fresh.row(0)).norm(), 1e-12);
  Leaf other = c.leaf;
  other.seed = 2;
  EXPECT_GT((senescence_pattern(other, c.venation, c.pigments).ahead - c.pattern.ahead).cwiseAbs().maxCoeff(),
            0.02);
}

// Oracle: a red species reddens where it makes anthocyanin, and only there.
TEST(Senescence, MapleReddensInPatches) {
  const Case c = make_case("maple");
  EXPECT_LT(c.pattern.redness.minCoeff(), 0.25);
  EXPECT_GT(c.pattern.redness.maxCoeff(), 0.75);
  const TissueColours colours(c.pigments);
  const Vec3 yellow = colours({0.65, 0.0, 0.0}), red = colours({0.65, 1.0, 0.0});
  EXPECT_LT(red.y() / red.x(), 0.6 * yellow.y() / yellow.x());
}

// Differential: the table against the optics that it tabulates.
TEST_P(EveryPigmentation, TableAgreesWithTheOptics) {
  const Pigmentation& p = species(GetParam()).pigments;
  const TissueColours colours(p);
  Random random(3, "states");
  for (int trial = 0; trial < 500; ++trial) {
    const TissueState state{random.uniform(0.0, kOldest), random.uniform(), random.uniform()};
    const Vec3 exact = leaf_light(senescent_tissue(p, state)).reflectance;
    EXPECT_LT((colours(state) - exact).cwiseAbs().maxCoeff(), 0.006) << state.age << " " << state.redness;
  }
}

}  // namespace
}  // namespace wilt
