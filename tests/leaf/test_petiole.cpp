#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "support/meshes.hpp"
#include "wilt/core/error.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

struct MarginCase {
  Points2 margin;
  int truth = 0;
};

MarginCase margin_of(const Leaf& leaf) {
  const std::vector<VertexId>& loop = margin_loop(leaf.mesh, leaf.positions);
  MarginCase result;
  result.margin.resize(static_cast<int>(loop.size()), 2);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    result.margin.row(static_cast<int>(i)) = leaf.positions.row(loop[i]).head<2>();
    if (loop[i] == leaf.petiole) result.truth = static_cast<int>(i);
  }
  return result;
}

// r(phi), phi from the apex at +y; the base is at the bottom.
Points2 polar(int count, const std::function<double(double)>& radius) {
  Points2 ring(count, 2);
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * std::numbers::pi * i / count;
    ring.row(i) << radius(phi) * std::sin(phi), radius(phi) * std::cos(phi);
  }
  return ring;
}

// Oracle: the procedural leaves' own petiole vertex.
TEST(FindPetiole, IsExactForEverySpeciesSizeAndSeed) {
  for (const std::string& name : species_names()) {
    for (const int vertices : {800, 2000, 5000}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const MarginCase c = margin_of(make_leaf(name, vertices, seed));
        const PetioleGuess guess = find_petiole(c.margin);
        const int n = static_cast<int>(c.margin.rows()), apart = std::abs(guess.index - c.truth);
        EXPECT_EQ(std::min(apart, n - apart), 0) << name << ' ' << vertices << ' ' << seed;
        EXPECT_GT(guess.confidence, 0.5) << name << ' ' << vertices << ' ' << seed;
      }
    }
  }
}

// Oracle: rigid motion, scale, direction and start of the numbering do not change a shape.
TEST(FindPetiole, IsInvariantToMotionScaleAndNumbering) {
  for (const char* name : {"maple", "poplar", "willow", "grape"}) {
    const MarginCase c = margin_of(make_leaf(name, 800, 3));
    const int n = static_cast<int>(c.margin.rows());
    for (const int shift : {0, 1, n / 3, n - 5}) {
      for (const bool reversed : {false, true}) {
        const double angle = 0.7 * shift, scale = 1.0 + 100.0 * shift;
        Points2 other(n, 2);
        for (int i = 0; i < n; ++i) {
          const int from = reversed ? (2 * n - i + shift) % n : (i + shift) % n;
          const Vec2 p = c.margin.row(from);
          other.row(i) << scale * (std::cos(angle) * p.x() - std::sin(angle) * p.y()) + 5.0,
              scale * (std::sin(angle) * p.x() + std::cos(angle) * p.y()) - 3.0;
        }
        const int found = find_petiole(other).index;
        EXPECT_EQ(reversed ? (2 * n - found + shift) % n : (found + shift) % n, c.truth)
            << name << ' ' << shift << ' ' << reversed;
      }
    }
  }
}

// Oracle: shapes whose base is known by construction, at the bottom (phi = pi).
TEST(FindPetiole, KnowsTheBaseOfTextbookShapes) {
  const double pi = std::numbers::pi;
  const auto base_of = [](const Points2& ring) { return Vec2(ring.row(find_petiole(ring).index)); };
  // Ovate: an egg, wider below, pointed above.
  Points2 ovate(240, 2);
  for (int i = 0; i < 240; ++i) {
    const double t = 2 * pi * i / 240;
    ovate.row(i) << 0.5 * std::sin(t) * (1 - 0.35 * std::cos(t)), std::cos(t);
  }
  EXPECT_LT((base_of(ovate) - Vec2(0, -1)).norm(), 0.06);
  // Cordate: a cardioid with its cusp at the bottom.
  const Points2 cordate = polar(241, [](double phi) { return 1.0 + 0.9 * std::cos(phi); });
  EXPECT_LT((base_of(cordate) - Vec2(0, -0.1)).norm(), 0.06);
  // Deltoid: a triangle on its side, the petiole in the middle of the base.
  Points2 deltoid(120, 2);
  for (int i = 0; i < 40; ++i) {
    const double t = i / 40.0;
    deltoid.row(i) << -0.5 + t, 0.0;
    deltoid.row(40 + i) << 0.5 - 0.5 * t, 1.2 * t;
    deltoid.row(80 + i) << -0.5 * t, 1.2 - 1.2 * t;
  }
  EXPECT_LT((base_of(deltoid) - Vec2(0, 0)).norm(), 0.06);
}

// Oracle: an ellipse has no base; nothing speaks for either end.
TEST(FindPetiole, IsUnsureAboutAnEllipse) {
  Points2 ellipse(200, 2);
  for (int i = 0; i < 200; ++i) {
    const double t = 2 * std::numbers::pi * i / 200;
    ellipse.row(i) << 0.4 * std::cos(t), std::sin(t);
  }
  const PetioleGuess guess = find_petiole(ellipse);
  EXPECT_LT(guess.confidence, 0.05);
  EXPECT_GT(std::abs(ellipse(guess.index, 1)), 0.95);
}

// Oracle: the definition of the frame, and the placement that must give the file's coordinates back.
TEST(PlaceInLeafFrame, PutsThePetioleAtTheOriginAndMapsBack) {
  const test::Surface sheet = test::bent(test::grid(8, 12, 1.0, 2.0), [](const Vec3& p) {
    return Vec3(3 + p.z(), 4 - p.y(), 5 + p.x() + 0.05 * p.y() * p.y());
  });
  Leaf leaf;
  leaf.mesh = sheet.mesh;
  const VertexId petiole(4);  // the middle of the short side
  place_in_leaf_frame(leaf, sheet.positions, petiole, 0.001);
  EXPECT_EQ(leaf.petiole, petiole);
  EXPECT_EQ(leaf.positions.row(petiole).norm(), 0.0);
  const Vec3 up = area_vector(leaf.mesh, leaf.positions).normalized();
  EXPECT_NEAR(up.z(), 1.0, 1e-12);
  int farthest = 0;
  leaf.positions.rowwise().norm().maxCoeff(&farthest);
  EXPECT_NEAR(leaf.positions(farthest, 0), 0.0, 1e-12);
  EXPECT_GT(leaf.positions(farthest, 1), 0.0);
  EXPECT_NEAR(leaf.placement.rotation.determinant(), 1.0, 1e-12);
  for (const VertexId v : leaf.mesh.vertices()) {
    const Vec3 back = leaf.placement.scale * leaf.placement.rotation * leaf.positions.row(v).transpose() +
                      leaf.placement.translation;
    EXPECT_LT((back - sheet.positions.row(v).transpose()).norm(), 1e-12);
  }
}

// Oracle: a sphere-like cap closed to where the area vector vanishes has no upper side.
TEST(PlaceInLeafFrame, RefusesASurfaceWithoutAnUpperSide) {
  Leaf leaf;
  Faces faces(4, 3);
  faces << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
  leaf.mesh = SurfaceMesh(5, faces);
  Points3 positions(5, 3);
  positions << 0, 0, 1, 1, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0;
  EXPECT_THROW(place_in_leaf_frame(leaf, positions, VertexId(1), 1.0), Error);
}

// Oracles: the nearest margin vertex by hand; a rigid motion keeps all distances; the definition of the
// frame.
TEST(WithPetiole, HoldsALeafByAnotherPlaceOfItsMargin) {
  const Leaf leaf = make_leaf("maple", 500, 3);
  const Vec2 wanted(0.03, 0.05);
  const Leaf moved = with_petiole(leaf, wanted);
  const auto away = [&](VertexId v) { return (leaf.positions.row(v).head<2>().transpose() - wanted).norm(); };
  EXPECT_TRUE(moved.mesh.is_boundary(moved.petiole));
  EXPECT_NE(moved.petiole, leaf.petiole);
  for (const VertexId v : leaf.mesh.vertices()) {
    EXPECT_TRUE(!leaf.mesh.is_boundary(v) || away(moved.petiole) <= away(v)) << v;
    const VertexId w((v + 77) % leaf.mesh.num_vertices());
    EXPECT_NEAR((moved.positions.row(v) - moved.positions.row(w)).norm(),
                (leaf.positions.row(v) - leaf.positions.row(w)).norm(), 1e-14);
  }
  EXPECT_EQ(moved.positions.row(moved.petiole).norm(), 0.0);
  EXPECT_NEAR(area_vector(moved.mesh, moved.positions).normalized().z(), 1.0, 1e-12);
  int farthest = 0;
  moved.positions.rowwise().norm().maxCoeff(&farthest);
  EXPECT_NEAR(moved.positions(farthest, 0), 0.0, 1e-12);
  EXPECT_GT(moved.positions(farthest, 1), 0.0);
  EXPECT_EQ(moved.stalk.centreline, leaf.stalk.centreline);  // in the leaf frame, which begins at the petiole
  EXPECT_EQ(moved.placement.scale, 1.0);
  EXPECT_TRUE(moved.placement.rotation.isIdentity(0.0) && moved.placement.translation.isZero(0.0));
  EXPECT_EQ(moved.notes.size(), leaf.notes.size() + 1);
}

// Oracle: the loops of a leaf with an opening, the longer of which is the margin.
TEST(WithPetiole, TakesTheOuterMarginOfAHoledLeaf) {
  Leaf leaf = make_leaf("ivy", 800, 1);
  const auto all = leaf.mesh.face_matrix();
  const auto is_inner = [&](int f) {
    for (int k = 0; k < 3; ++k) {
      if (leaf.mesh.is_boundary(VertexId(all(f, k)))) return false;
    }
    return true;
  };
  int out = static_cast<int>(all.rows()) / 2;
  while (!is_inner(out)) ++out;
  Faces faces(all.rows() - 1, 3);
  faces << all.topRows(out), all.bottomRows(all.rows() - out - 1);
  leaf.mesh = SurfaceMesh(leaf.mesh.num_vertices(), faces);
  ASSERT_EQ(leaf.mesh.boundary_loops().size(), 2u);
  for (const std::vector<VertexId>& loop : leaf.mesh.boundary_loops()) {
    const Leaf moved = with_petiole(leaf, leaf.positions.row(loop[0]).head<2>().transpose());
    EXPECT_EQ(moved.petiole == loop[0], loop.size() > 3);
  }
}

}  // namespace
}  // namespace wilt
