// The six species, from geometry alone. Larger leaves and more seeds stand in docs/validation.md.
#include <gtest/gtest.h>

#include <string>

#include "venation/leaves.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

struct Expected {
  std::string species;
  int tips;
  double stress;  ///< three times what a prototype's leaf of 1,050 vertices has; individuals vary
};

const Expected kExpected[] = {{"maple", 7, 3 * 4.2e-3}, {"poplar", 1, 3 * 1.2e-4}, {"tilia", 1, 3 * 1.2e-4},
                              {"ivy", 5, 3 * 1.2e-4},   {"willow", 1, 3 * 1.2e-4}, {"grape", 5, 3 * 2.4e-4}};

VenationOptions without_secondary() {
  VenationOptions options;
  options.secondary = false;
  return options;
}

class EverySpecies : public testing::TestWithParam<Expected> {};

INSTANTIATE_TEST_SUITE_P(Venation, EverySpecies, testing::ValuesIn(kExpected),
                         [](const auto& parameter) { return parameter.param.species; });

// Oracle: botany; the number of lobes that make_leaf draws.
TEST_P(EverySpecies, HasItsTips) {
  const Venation venation = find_venation(make_leaf(GetParam().species, 800, 1), {}, without_secondary());
  EXPECT_EQ(static_cast<int>(venation.tips.size()), GetParam().tips);
  EXPECT_LT(venation.embedding_stress, GetParam().stress);
}

TEST_P(EverySpecies, HasItsTipsByLandmarks) {
  VenationOptions options = without_secondary();
  options.full_embedding_up_to = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Venation venation = find_venation(make_leaf(GetParam().species, 1200, seed), {}, options);
    EXPECT_EQ(static_cast<int>(venation.tips.size()), GetParam().tips) << "seed " << seed;
  }
}

// Oracle: invariance. The same leaf from a file: rounded to float, numbered anew, nameless.
TEST_P(EverySpecies, HasTheSameTipsWhenReadBack) {
  const Leaf leaf = make_leaf(GetParam().species, 800, 4);
  const Venation venation = find_venation(leaf, {}, without_secondary());
  std::vector<int> number;
  const Venation same = find_venation(test::read_back(leaf, 4, &number), {}, without_secondary());
  ASSERT_EQ(same.tips.size(), venation.tips.size());
  for (std::size_t i = 0; i < same.tips.size(); ++i)
    EXPECT_EQ(same.tips[i].vertex, number[venation.tips[i].vertex]);
}

// Differential: fast distances against exact ones, from sources all over the leaf. Band: what the method
// promises.
TEST_P(EverySpecies, HasNearExactFastDistances) {
  const Leaf leaf = make_leaf(GetParam().species, 1000, 1);
  const int n = leaf.mesh.num_vertices();
  std::vector<VertexId> sources;
  for (int v = 0; v < n; v += 50) sources.push_back(VertexId(v));
  const auto by = [&](GeodesicMethod method) {
    return geodesic_distances(leaf.mesh, leaf.positions, sources, method);
  };
  const Eigen::ArrayXXd exact = by(GeodesicMethod::exact), fast = by(GeodesicMethod::fast);
  const Eigen::ArrayXXd error = (fast - exact).abs() / exact.max(1e-12);
  EXPECT_LT(error.mean(), 2e-4);
  EXPECT_LT(error.maxCoeff(), 0.04);
}

// Differential: primary veins, sought in bands, against exact paths sought everywhere.
TEST_P(EverySpecies, HasTheShortestPrimaryVeins) {
  for (const int vertices : {800, 3000}) {
    const Leaf leaf = make_leaf(GetParam().species, vertices, 2);
    const Venation venation = find_venation(leaf, {}, without_secondary());
    std::vector<VertexId> tips;
    for (const Tip& tip : venation.tips) tips.push_back(tip.vertex);
    const auto paths = ExactGeodesics(leaf.mesh, leaf.positions).paths(leaf.petiole, tips);
    for (std::size_t i = 0; i < tips.size(); ++i)
      EXPECT_NEAR(venation.veins[i].path.length, paths[i].length, 1e-12 * paths[i].length)
          << vertices << " " << i;
  }
}

// Oracle: botany. A feather in a leaf with one midrib; lateral veins on each primary of a palmate leaf.
TEST_P(EverySpecies, HasSecondaryVeins) {
  const Leaf leaf = make_leaf(GetParam().species, 800, 1);
  VenationOptions options;
  options.full_embedding_up_to = 0;
  const Venation venation = find_venation(leaf, species(GetParam().species).secondary, options);
  std::vector<int> children(venation.tips.size(), 0);
  for (const Vein& vein : venation.veins) {
    if (vein.order == 2) ++children[vein.parent];
  }
  for (const int count : children) EXPECT_GE(count, GetParam().tips == 1 ? 6 : 1);
}

}  // namespace
}  // namespace wilt
