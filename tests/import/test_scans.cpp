// Scans whose surface is known exactly: blades rolled on a cylinder, sampled at random with errors. Lengths
// in the scan's unit; a blade is 100 long and its points are about 1 apart.
#include <gtest/gtest.h>

#include "import/files.hpp"
#include "import/scan_files.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using test::RolledBlade;

constexpr int kPoints = 6000;

struct Compared {
  double error;     // root mean square distance of the vertices to the true surface
  Outline outline;  // of the leaf, unrolled
  Points2 flat;     // its vertices, unrolled
};

Compared compare(const Leaf& leaf, const RolledBlade& truth) {
  Compared result;
  const Points3 places = test::in_file(leaf);
  result.flat.resize(places.rows(), 2);
  double squares = 0.0;
  for (int i = 0; i < places.rows(); ++i) {
    squares += std::pow(truth.height(places.row(i).transpose()), 2);
    result.flat.row(i) = truth.unroll(places.row(i).transpose()).transpose();
  }
  result.error = std::sqrt(squares / double(places.rows()));
  const std::vector<VertexId>& margin = margin_loop(leaf.mesh, leaf.positions);
  result.outline.margin.resize(static_cast<int>(margin.size()), 2);
  for (std::size_t i = 0; i < margin.size(); ++i) result.outline.margin.row(i) = result.flat.row(margin[i]);
  return result;
}

double distance_to(const Points2& points, const Vec2& place) {
  return (points.rowwise() - place.transpose()).rowwise().norm().minCoeff();
}

struct Case {
  const char* species;
  double radius;  // a blade is 100 long and 40 to 100 wide
  double noise;
  int points;
  double reach;  // of a tip and of the petiole: needle tips and sinuses as narrow as the spacing are lost
};

std::ostream& operator<<(std::ostream& stream, const Case& c) {
  return stream << c.species << " rolled to " << c.radius << ", noise " << c.noise << ", points " << c.points;
}

class Scans : public test::Files {};
class RolledScan : public test::Files, public ::testing::WithParamInterface<Case> {};

// Oracle: the cylinder and the outline that the points were taken from. The bounds: a fit that smooths lies
// nearer to the truth than the points do; of the margin nothing is known between two points.
TEST_P(RolledScan, IsRecoveredWithinItsNoise) {
  const RolledBlade truth(GetParam().species, GetParam().radius);
  ReadOptions options;
  options.vertices = 4000;
  const Leaf leaf =
      read_leaf(write("leaf.xyz", test::lines(truth.scan(GetParam().points, GetParam().noise))), options);
  const Compared compared = compare(leaf, truth);
  EXPECT_LT(compared.error, 0.5 * GetParam().noise) << test::notes_of(leaf);
  EXPECT_GT(test::overlap_ratio(compared.outline, truth.outline()), 0.97);
  for (const Vec2& tip : truth.tips())
    EXPECT_LT(distance_to(compared.outline.margin, tip), GetParam().reach) << tip.transpose();
  EXPECT_LT(compared.flat.row(leaf.petiole).norm(), GetParam().reach) << test::notes_of(leaf);
  EXPECT_TRUE(test::has_note(leaf, "millimetres"));
  EXPECT_GT(smallest_angle(leaf.mesh, leaf.positions), 15.0 * 3.14159265 / 180);
}

INSTANTIATE_TEST_SUITE_P(Blades, RolledScan,
                         ::testing::Values(Case{"poplar", 60.0, 0.5, 6000, 6.0},
                                           Case{"maple", 1e4, 0.5, 24000, 6.0},
                                           Case{"maple", 40.0, 0.5, 24000, 6.0},
                                           Case{"tilia", 20.0, 0.3, 6000, 5.0},
                                           Case{"grape", 30.0, 0.5, 12000, 4.0}));

// Oracle: the same leaf without what was added. Strays are spread over the bounding box, others lie near.
TEST_F(Scans, StraysAndRepeatedPointsChangeLittle) {
  const RolledBlade truth("poplar", 40.0);
  std::vector<Vec3> points = truth.scan(kPoints, 0.4);
  Random random(5, "strays");
  for (int i = 0; i < kPoints / 20; ++i)
    points.push_back({random.uniform(-60, 60), random.uniform(-20, 120), random.uniform(-20, 60)});
  for (int i = 0; i < kPoints / 50; ++i) points[i] += Vec3(0, 0, 6.0 * random.normal());
  for (int i = 0; i < 100; ++i) points.push_back(points[i]);
  const Leaf leaf = read_leaf(write("leaf.csv", "X,Y,Z\n" + test::lines(points, ",")));
  const Compared compared = compare(leaf, truth);
  EXPECT_LT(compared.error, 0.3) << test::notes_of(leaf);
  EXPECT_GT(test::overlap_ratio(compared.outline, truth.outline()), 0.97);
  EXPECT_TRUE(test::has_note(leaf, "100 repeated points"));
}

// Oracle: the holes that were cut; one is 14 across, the other 3, about as wide as gaps between points are.
TEST_F(Scans, KeepLargeHolesAndCloseSmallOnes) {
  const RolledBlade truth("poplar", 60.0);
  std::vector<Vec3> points = truth.scan(kPoints, 0.3);
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](const Vec3& p) {
                                const Vec2 at = truth.unroll(p);
                                return (at - Vec2(12, 40)).norm() < 7.0 || (at - Vec2(-12, 30)).norm() < 1.5;
                              }),
               points.end());
  const Leaf leaf = read_leaf(write("leaf.xyz", test::lines(points)));
  ASSERT_EQ(leaf.mesh.boundary_loops().size(), 2u) << test::notes_of(leaf);
  const std::vector<VertexId>* hole = &leaf.mesh.boundary_loops()[0];
  if (hole == &margin_loop(leaf.mesh, leaf.positions)) hole = &leaf.mesh.boundary_loops()[1];
  const Points2 flat = compare(leaf, truth).flat;
  Vec2 centre = Vec2::Zero();
  for (const VertexId v : *hole) centre += flat.row(v).transpose() / double(hole->size());
  EXPECT_LT((centre - Vec2(12, 40)).norm(), 1.0);
  EXPECT_NEAR(loop_length(leaf.positions, *hole) * 1000, 2 * 3.14159 * 7.0, 5.0);
}

// Oracle: invariance.
TEST_F(Scans, DoNotDependOnTheOrderOfThePoints) {
  std::vector<Vec3> points = RolledBlade("ivy", 50.0).scan(3000, 0.5);
  const Leaf one = read_leaf(write("one.xyz", test::lines(points)));
  Random random(11, "order");
  for (int i = static_cast<int>(points.size()) - 1; i > 0; --i)
    std::swap(points[i], points[random.index(i + 1)]);
  const Leaf other = read_leaf(write("other.xyz", test::lines(points)));
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.mesh.face_matrix(), other.mesh.face_matrix());
}

// Oracle: invariance. A turned scan gets other nodes, so it agrees to a share of the noise only (0.5 % of the
// length); the upper side is the one that faces +z, which this turn keeps.
TEST_F(Scans, TurnMoveAndScaleWithTheFile) {
  const RolledBlade truth("poplar", 50.0);
  const std::vector<Vec3> points = truth.scan(kPoints, 0.5);
  const Leaf one = read_leaf(write("one.xyz", test::lines(points)));
  Eigen::Matrix3d turn;
  turn << 0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6;
  std::vector<Vec3> moved;
  for (const Vec3& p : points) moved.push_back(1e-3 * (turn * p + Vec3(300, -200, 100)));
  const Leaf other = read_leaf(write("other.xyz", test::lines(moved)));
  EXPECT_TRUE(test::has_note(other, "metres"));
  EXPECT_NEAR(leaf_length(other), leaf_length(one), 0.01 * leaf_length(one));
  EXPECT_NEAR(surface_area(other.mesh, other.positions), surface_area(one.mesh, one.positions),
              0.01 * surface_area(one.mesh, one.positions));
  const Vec3 normal = other.placement.rotation.col(2), expected = turn * one.placement.rotation.col(2);
  EXPECT_GT(normal.dot(expected), 0.999);
}

TEST_F(Scans, TakeTheUnitThatIsGiven) {
  const std::string text = test::lines(RolledBlade("poplar", 1e4).scan(2000, 0.2));
  ReadOptions options;
  options.mm_per_unit = 2.0;
  EXPECT_NEAR(leaf_length(read_leaf(write("leaf.xyz", text), options)), 0.2,
              0.008);  // the petiole is found within 4 %
  options.mm_per_unit = 0.0;
  EXPECT_NE(refusal(write("leaf.xyz", text), options, ErrorCode::configuration).find("--mm-per-unit 0"),
            std::string::npos);
}

// Oracle: where the stalk was put, from (0, 0) downwards: once as dense as the blade, once 12 points.
TEST_F(Scans, FindTheStalk) {
  const RolledBlade truth("poplar", 60.0);
  for (const int count : {600, 12}) {
    std::vector<Vec3> points = truth.scan(kPoints, 0.3);
    Random random(2, "stalk");
    for (int i = 0; i < count; ++i)
      points.push_back(truth.roll({random.uniform(-1.2, 1.2), -40.0 * (i + 0.5) / count}));
    const Leaf leaf = read_leaf(write("leaf.txt", test::lines(points, "\t")));
    EXPECT_TRUE(test::has_note(leaf, count == 12 ? "a trail of points" : "a stalk was cut off"))
        << test::notes_of(leaf);
    EXPECT_LT(compare(leaf, truth).flat.row(leaf.petiole).norm(), 4.0) << count;
    EXPECT_EQ(leaf.stalk.centreline.rows() > 0, count == 600);
  }
}

TEST_F(Scans, TakeThePetioleThatIsGiven) {
  const RolledBlade truth("poplar", 60.0);
  ReadOptions options;
  options.petiole = Vec2(0.0, 100.0);
  const Leaf leaf = read_leaf(write("leaf.xyz", test::lines(truth.scan(3000, 0.3))), options);
  EXPECT_LT((compare(leaf, truth).flat.row(leaf.petiole) - Eigen::RowVector2d(0, 100)).norm(), 4.0);
}

// Oracle: the file of points; meshes are Y up, so the same points are (x, z, -y) there.
TEST_F(Scans, ComeAsPlyWithoutFacesAndAsMeshes) {
  const RolledBlade truth("poplar", 60.0);
  const std::vector<Vec3> points = truth.scan(3000, 0.3);
  const Leaf plain = read_leaf(write("leaf.xyz", test::lines(points)));
  std::vector<Vec3> y_up;
  for (const Vec3& p : points) y_up.push_back({p.x(), p.z(), -p.y()});
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x\nproperty float y\nproperty float z\n";
  const Leaf cloud = read_leaf(write("cloud.ply", header + "end_header\n" + test::lines(y_up)));
  std::string faces;  // any, for they are left out
  for (int i = 0; i < 1000; ++i) faces += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  ReadOptions options;
  options.scan = true;
  const Leaf mesh = read_leaf(
      write("mesh.ply", header + "element face 1000\nproperty list uchar int vertex_indices\nend_header\n" +
                            test::lines(y_up) + faces),
      options);
  for (const Leaf* leaf : {&cloud, &mesh}) {
    EXPECT_NEAR(leaf_length(*leaf), leaf_length(plain), 1e-3);
    EXPECT_NEAR(surface_area(leaf->mesh, leaf->positions), surface_area(plain.mesh, plain.positions),
                0.005 * surface_area(plain.mesh, plain.positions));
    EXPECT_LT(compare(*leaf, truth).error, 0.15);
  }
}

TEST_F(Scans, OfSeveralLeavesGiveTheLargestOrTheOneAskedFor) {
  const RolledBlade large("poplar", 60.0), other("grape", 60.0);
  std::vector<Vec3> points = large.scan(5000, 0.3);
  for (const Vec3& p : other.scan(5000, 0.3)) points.push_back(0.6 * p + Vec3(200, 0, 0));
  const std::filesystem::path file = write("two.xyz", test::lines(points));
  const Leaf first = read_leaf(file);
  EXPECT_TRUE(test::has_note(first, "2 pieces")) << test::notes_of(first);
  EXPECT_NEAR(leaf_length(first), 0.1, 0.004);
  ReadOptions options;
  options.nth = 2;
  EXPECT_GT(test::in_file(read_leaf(file, options)).col(0).minCoeff(), 140.0);
  options.nth = 3;
  EXPECT_NE(refusal(file, options).find("there is no leaf 3"), std::string::npos);
}

// A scanner's file of many points is thinned; oracle: the true surface.
TEST_F(Scans, WithVeryManyPointsAreThinned) {
  const RolledBlade truth("poplar", 60.0);
  const Leaf leaf = read_leaf(write("leaf.xyz", test::lines(truth.scan(200'000, 0.5))));
  EXPECT_TRUE(test::has_note(leaf, "of 200000 points every 5th was used")) << test::notes_of(leaf);
  const Compared compared = compare(leaf, truth);
  EXPECT_LT(compared.error, 0.12) << test::notes_of(leaf);
  EXPECT_GT(test::overlap_ratio(compared.outline, truth.outline()), 0.975);
}

}  // namespace
}  // namespace wilt
