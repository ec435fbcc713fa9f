#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "leaf/peaks.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt {
namespace {

constexpr double kTwentyDegrees = 20.0 * std::numbers::pi / 180.0;

// Property over species, sizes and seeds. Oracle: the botany, through an independent peak finder on the
// margin of the mesh seen from above.
TEST(MakeLeaf, ShowsTheTipsOfItsSpeciesAtEveryResolution) {
  for (const std::string& name : species_names()) {
    for (const int vertices : {800, 2000, 5000}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Leaf leaf = make_leaf(name, vertices, seed);
        std::vector<Vec2> ring;
        for (const VertexId v : margin_loop(leaf.mesh, leaf.positions)) {
          ring.push_back(leaf.positions.row(v).head<2>().transpose());
        }
        int tips = 0;
        for (const double p : test::prominences(ring, Vec2::Zero())) tips += p >= 0.02;
        EXPECT_EQ(tips, test::expected_tips(name)) << name << " " << vertices << " seed " << seed;
      }
    }
  }
}

// Oracle: areas as g++ made them; clang and em++ must make the same individuals. In m^2.
TEST(MakeLeaf, IsTheSameIndividualUnderEveryCompiler) {
  const std::map<std::string, double> areas = {
      {"maple", 0.013775772879472518}, {"poplar", 0.002953962743780312},  {"tilia", 0.0038514687420559825},
      {"ivy", 0.0030246431335271373},  {"willow", 0.0008527861602727244}, {"grape", 0.016880656708108784}};
  for (const auto& [name, area] : areas) {
    const Leaf leaf = make_leaf(name, 800, 5);
    EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), area, 1e-9 * area) << name;
  }
}

TEST(MakeLeaf, IsABladeOfTrueSizeInTheLeafFrame) {
  for (const std::string& name : species_names()) {
    for (const int vertices : {200, 2000}) {
      const Leaf leaf = make_leaf(name, vertices, 3);
      validate_blade(leaf.mesh, leaf.positions);
      EXPECT_NEAR(leaf.mesh.num_vertices(), vertices, 0.05 * vertices) << name;
      EXPECT_GE(smallest_angle(leaf.mesh, leaf.positions), kTwentyDegrees) << name;
      EXPECT_NEAR(leaf_length(leaf), species(name).length, 1e-12) << name;
      EXPECT_EQ(leaf.positions.row(leaf.petiole).norm(), 0.0) << name;
      EXPECT_TRUE(leaf.mesh.is_boundary(leaf.petiole)) << name;
      // The apex lies ahead: the highest y is more than nine tenths of the length, next to the y axis.
      Eigen::Index apex = 0;
      const double top = leaf.positions.col(1).maxCoeff(&apex);
      EXPECT_GT(top, 0.85 * leaf_length(leaf)) << name;
      EXPECT_LT(std::abs(leaf.positions(apex, 0)), 0.06 * leaf_length(leaf)) << name;
      EXPECT_EQ(leaf.name, name);
      EXPECT_EQ(leaf.species, name);
      EXPECT_EQ(leaf.seed, 3u);
      EXPECT_TRUE(leaf.notes.empty());
    }
  }
}

// The upper side faces up everywhere, and the relief is that of a fresh leaf: slopes below 30 degrees, but no
// plane.
TEST(MakeLeaf, IsGentlyCurvedAndFacesUp) {
  for (const std::string& name : species_names()) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Leaf leaf = make_leaf(name, 1500, seed);
      double steepest = 0.0;
      const Points3 normals = vertex_normals(leaf.mesh, leaf.positions);
      for (Eigen::Index i = 0; i < normals.rows(); ++i) {
        ASSERT_GT(normals(i, 2), 0.0) << name;
        steepest = std::max(steepest, std::acos(std::min(1.0, normals(i, 2))));
      }
      EXPECT_LT(steepest, 30.0 * std::numbers::pi / 180.0) << name << " seed " << seed;
      EXPECT_GT(steepest, 6.0 * std::numbers::pi / 180.0) << name << " seed " << seed;
    }
  }
}

TEST(MakeLeaf, HasASkinThatFitsTheTexture) {
  const Leaf leaf = make_leaf("maple", 1000, 1);
  ASSERT_EQ(leaf.skin.uv.rows(), leaf.positions.rows());
  EXPECT_EQ(leaf.skin.faces, leaf.mesh.face_matrix());
  EXPECT_NEAR(leaf.skin.uv.minCoeff(), 1.0 / 64.0, 1e-12);
  EXPECT_NEAR(leaf.skin.uv.maxCoeff(), 63.0 / 64.0, 1e-12);
  // One scale for both axes, v downwards: uv is a similarity of x and -y.
  const Eigen::RowVector2d uv = leaf.skin.uv.row(7) - leaf.skin.uv.row(500);
  const Eigen::RowVector2d xy = leaf.positions.row(7).head<2>() - leaf.positions.row(500).head<2>();
  EXPECT_NEAR(uv.x() * -xy.y(), uv.y() * xy.x(), 1e-12);
  EXPECT_GT(uv.x() * xy.x(), 0.0);
}

TEST(MakeLeaf, HangsFromAStalk) {
  for (const std::string& name : species_names()) {
    const Leaf leaf = make_leaf(name, 300, 2);
    const Points3& line = leaf.stalk.centreline;
    ASSERT_EQ(static_cast<std::size_t>(line.rows()), leaf.stalk.radii.size()) << name;
    EXPECT_EQ(line.row(0).norm(), 0.0) << name;
    double length = 0.0;
    for (Eigen::Index i = 1; i < line.rows(); ++i) length += (line.row(i) - line.row(i - 1)).norm();
    const Species& kind = species(name);
    EXPECT_NEAR(length / (kind.length * kind.stalk_length), 1.0, 0.16) << name;  // individuals differ by 15 %
    EXPECT_LT(line(line.rows() - 1, 1), -0.5 * length) << name;
    EXPECT_GT(leaf.stalk.radii.back(), leaf.stalk.radii.front()) << name;
  }
}

TEST(MakeLeaf, SameSeedSameBytesOtherSeedOtherLeaf) {
  for (const std::string& name : species_names()) {
    const Leaf one = make_leaf(name, 600, 1);
    const Leaf again = make_leaf(name, 600, 1);
    EXPECT_EQ(one.positions, again.positions) << name;
    EXPECT_EQ(one.mesh.face_matrix(), again.mesh.face_matrix()) << name;
    EXPECT_EQ(one.stalk.centreline, again.stalk.centreline) << name;
    const Leaf other = make_leaf(name, 600, 2);
    const Eigen::Index n = std::min(one.positions.rows(), other.positions.rows());
    EXPECT_GT((one.positions.topRows(n) - other.positions.topRows(n)).norm(), 0.0) << name;
    EXPECT_GT((one.stalk.centreline - other.stalk.centreline).norm(), 0.0) << name;
  }
}

TEST(PlanarSkin, CentresAFlatSquare) {
  Points3 positions(4, 3);
  positions << 0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0;
  Faces faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  const Skin skin = planar_skin(SurfaceMesh(4, faces), positions);
  // Width 2 fills 62/64 of the texture; height 1 is centred: 31/64 around one half.
  EXPECT_NEAR(skin.uv(0, 0), 1.0 / 64.0, 1e-15);
  EXPECT_NEAR(skin.uv(1, 0), 63.0 / 64.0, 1e-15);
  EXPECT_NEAR(skin.uv(0, 1), 0.5 + 15.5 / 64.0, 1e-15);
  EXPECT_NEAR(skin.uv(2, 1), 0.5 - 15.5 / 64.0, 1e-15);
}

}  // namespace
}  // namespace wilt
