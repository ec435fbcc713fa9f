#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geodesics/leaf_surface.hpp"
#include "wilt/core/error.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"

namespace wilt {
namespace {

// Round-off of some dozens of unfoldings; distances are of order 1.
constexpr double kRound = 1e-13;

std::vector<VertexId> all_vertices(const SurfaceMesh& mesh) {
  std::vector<VertexId> all;
  for (const VertexId v : mesh.vertices()) all.push_back(v);
  return all;
}

// Every path of `source`: as long as its distance, connected, from the source to the target.
void expect_paths_fit(const test::Surface& surface, VertexId source) {
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  const Eigen::VectorXd distances = geodesics.distances(source);
  const std::vector<SurfacePath> paths = geodesics.paths(source, all_vertices(surface.mesh));
  for (const VertexId v : surface.mesh.vertices()) {
    const SurfacePath& path = paths[v];
    ASSERT_FALSE(path.points.empty());
    const auto at = [&](const SurfacePoint& p) { return position(surface.mesh, surface.positions, p); };
    EXPECT_EQ(at(path.points.front()), surface.positions.row(source).transpose());
    EXPECT_EQ(at(path.points.back()), surface.positions.row(v).transpose());
    EXPECT_NEAR(path.length, distances[v], 1e-9 * distances[v]) << "to " << int(v);
    double length = 0.0;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      EXPECT_TRUE(common_face(surface.mesh, path.points[i - 1], path.points[i]).valid()) << "to " << int(v);
      length += (at(path.points[i]) - at(path.points[i - 1])).norm();
    }
    EXPECT_NEAR(length, path.length, kRound);
  }
  EXPECT_EQ(paths[source].points.size(), 1u);
}

// Oracle: on a flat convex domain the shortest path is the straight line. Grids are full of ties: rays
// through vertices and along edges.
TEST(ExactGeodesics, EqualEuclidOnAFlatConvexMesh) {
  for (const test::Surface& surface : {test::grid(12, 9, 1.2, 0.9), test::jittered_grid(12, 0.35, 5)}) {
    const ExactGeodesics geodesics(surface.mesh, surface.positions);
    for (const VertexId source : surface.mesh.vertices()) {
      const Eigen::VectorXd distances = geodesics.distances(source);
      const Eigen::VectorXd euclid =
          (surface.positions.rowwise() - surface.positions.row(source)).rowwise().norm();
      EXPECT_LT((distances - euclid).cwiseAbs().maxCoeff(), kRound) << int(source);
    }
    expect_paths_fit(surface, VertexId(0));
    expect_paths_fit(surface, VertexId(surface.mesh.num_vertices() / 2));
  }
}

// [0, 2]^2 without the open quarter x > 1, y > 1.
test::Surface l_shape(int cells) {
  const test::Surface square = test::grid(2 * cells, 2 * cells, 2.0, 2.0);
  std::vector<int> index(square.positions.rows(), -1);
  std::vector<Eigen::RowVector3i> faces;
  Points3 positions(square.positions.rows(), 3);
  int count = 0;
  for (const FaceId f : square.mesh.faces()) {
    Eigen::RowVector3i face = square.mesh.face_matrix().row(f);
    const Vec3 middle =
        (square.positions.row(face[0]) + square.positions.row(face[1]) + square.positions.row(face[2])) / 3.0;
    if (middle.x() > 1.0 && middle.y() > 1.0) continue;
    for (int& v : face) {
      if (index[v] < 0) positions.row(index[v] = count++) = square.positions.row(v);
      v = index[v];
    }
    faces.push_back(face);
  }
  Faces matrix(faces.size(), 3);
  for (int f = 0; f < matrix.rows(); ++f) matrix.row(f) = faces[f];
  return {SurfaceMesh(count, matrix), positions.topRows(count)};
}

// The length of the shortest path in the L between two of its points: straight, or bent at the corner (1, 1).
double l_distance(const Vec3& a, const Vec3& b) {
  const Vec3 corner(1.0, 1.0, 0.0);
  const double turn = (a - corner).cross(b - corner).z();
  // Only from one arm (y > 1) to the other (x > 1) can the corner be in the way.
  const bool arms = (a.y() > 1.0 && b.x() > 1.0) || (b.y() > 1.0 && a.x() > 1.0);
  const bool blocked = arms && (a.y() > 1.0 ? turn < 0.0 : turn > 0.0);
  return blocked ? (a - corner).norm() + (corner - b).norm() : (a - b).norm();
}

// Oracle: plane geometry around the one corner.
TEST(ExactGeodesics, BendAtAConcaveCorner) {
  const test::Surface surface = l_shape(5);
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  int bent = 0;
  for (const VertexId a : surface.mesh.vertices()) {
    const Eigen::VectorXd distances = geodesics.distances(a);
    for (const VertexId b : surface.mesh.vertices()) {
      const Vec3 p = surface.positions.row(a), q = surface.positions.row(b);
      const double expected = l_distance(p, q);
      EXPECT_NEAR(distances[b], expected, kRound) << p.transpose() << " to " << q.transpose();
      bent += expected > (p - q).norm() + 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(bent, 100);
  expect_paths_fit(surface, VertexId(surface.mesh.num_vertices() - 1));
}

// Oracle: a strip bent along its columns into a polygonal cylinder unrolls to the flat strip.
TEST(ExactGeodesics, UnrollAPolygonalCylinder) {
  const test::Surface flat = test::grid(12, 8, 3.0, 1.0);
  const double step = 3.0 / 12, turn = 0.3, radius = step / (2.0 * std::sin(turn / 2));
  const test::Surface bent = test::bent(flat, [&](const Vec3& p) {
    const double angle = turn * std::round(p.x() / step);
    return Vec3(radius * std::sin(angle), p.y(), radius * std::cos(angle));
  });
  const ExactGeodesics geodesics(bent.mesh, bent.positions);
  for (const VertexId source : bent.mesh.vertices()) {
    const Eigen::VectorXd unrolled = (flat.positions.rowwise() - flat.positions.row(source)).rowwise().norm();
    EXPECT_LT((geodesics.distances(source) - unrolled).cwiseAbs().maxCoeff(), kRound) << int(source);
  }
  expect_paths_fit(bent, VertexId(40));
}

// Oracle: opposite corners of the unit cube's surface are sqrt(5) apart, corners of one face sqrt(2).
TEST(ExactGeodesics, CrossTheUnitCube) {
  Points3 positions(8, 3);
  for (int v = 0; v < 8; ++v) positions.row(v) << (v & 1), ((v >> 1) & 1), ((v >> 2) & 1);
  Faces faces(12, 3);
  faces << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7,
      1, 7, 5;
  const test::Surface cube{SurfaceMesh(8, faces), positions};
  const ExactGeodesics geodesics(cube.mesh, cube.positions);
  for (int a = 0; a < 8; ++a) {
    const Eigen::VectorXd distances = geodesics.distances(VertexId(a));
    for (int b = 0; b < 8; ++b) {
      const int axes = (cube.positions.row(a) - cube.positions.row(b)).cwiseAbs().sum() + 0.5;
      const double expected[4] = {0.0, 1.0, std::sqrt(2.0), std::sqrt(5.0)};
      EXPECT_NEAR(distances[b], expected[axes], kRound) << a << " " << b;
    }
    expect_paths_fit(cube, VertexId(a));
  }
}

// Oracle: a cone of `sides` equal triangles around its tip. Two rim vertices that are an angle g < pi apart
// on the unrolled cone see each other straight, or past the tip when the cone is a saddle and g >= pi.
TEST(ExactGeodesics, GoRoundOrThroughTheTipOfACone) {
  for (const double corner : {0.4, 0.9}) {  // at the tip, radians: a cone (3.2), a saddle (7.2)
    const int sides = 8;
    // Legs of 1 from the tip; the rim zigzags in height so that 8 corners fit any total angle.
    const double chord = 2.0 * std::sin(corner / 2);
    double low = 0.0, high = 1.0;  // heights z and -z (saddle) or one common height (cone)
    const bool saddle = sides * corner > 2.0 * std::numbers::pi;
    const auto rim = [&](int k, double z) {
      const double r = std::sqrt(1.0 - z * z), t = 2.0 * std::numbers::pi * k / sides;
      return Vec3(r * std::cos(t), r * std::sin(t), saddle && k % 2 == 1 ? -z : z);
    };
    for (int i = 0; i < 200; ++i) {
      const double z = 0.5 * (low + high);
      const bool too_long = (rim(0, z) - rim(1, z)).norm() > chord;
      (too_long == saddle ? high : low) = z;
    }
    Points3 positions(sides + 1, 3);
    Faces faces(sides, 3);
    positions.row(sides).setZero();
    for (int k = 0; k < sides; ++k) {
      positions.row(k) = rim(k, low);
      faces.row(k) << sides, k, (k + 1) % sides;
    }
    const test::Surface cone{SurfaceMesh(sides + 1, faces), positions};
    const Eigen::VectorXd distances = ExactGeodesics(cone.mesh, cone.positions).distances(VertexId(0));
    for (int k = 0; k < sides; ++k) {
      const double gap = corner * std::min(k, sides - k);
      // A chord of two triangles or more would leave the surface at the rim vertices between: the rim is
      // convex on the unrolled cone, so it does not.
      const double expected = gap < std::numbers::pi ? 2.0 * std::sin(gap / 2) : 2.0;
      EXPECT_NEAR(distances[k], expected, 1e-12) << corner << " " << k;
    }
    expect_paths_fit(cone, VertexId(0));
  }
}

// Invariance: rigid motion and scale (1e-3 and 1e3) change distances by the scale alone.
TEST(ExactGeodesics, FollowRigidMotionAndScale) {
  const test::Surface surface = test::leaf(8, {.bumps = 0.15});
  const Eigen::VectorXd expected = ExactGeodesics(surface.mesh, surface.positions).distances(VertexId(5));
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Points3 moved = scale * surface.positions * rotation.transpose();
    moved.rowwise() += scale * Vec3(0.3, -2.0, 1.0).transpose();
    const Eigen::VectorXd distances = ExactGeodesics(surface.mesh, moved).distances(VertexId(5));
    EXPECT_LT((distances / scale - expected).cwiseAbs().maxCoeff(), 1e-12) << scale;
  }
}

// Invariance: vertices renumbered, faces reordered and rotated.
TEST(ExactGeodesics, DoNotDependOnNumbering) {
  const test::Surface surface = test::leaf(12, {.bumps = 0.15, .hole = true, .seed = 3});
  const int n = surface.mesh.num_vertices(), m = surface.mesh.num_faces();
  Random random(7, "relabelling");
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random.index(i + 1)]);
  Points3 positions(n, 3);
  Faces faces(m, 3);
  for (int v = 0; v < n; ++v) positions.row(order[v]) = surface.positions.row(v);
  for (int f = 0; f < m; ++f) {
    for (int k = 0; k < 3; ++k) faces(m - 1 - f, (k + f) % 3) = order[surface.mesh.face_matrix()(f, k)];
  }
  const SurfaceMesh mesh(n, faces);
  const Eigen::VectorXd expected = ExactGeodesics(surface.mesh, surface.positions).distances(VertexId(3));
  const Eigen::VectorXd distances = ExactGeodesics(mesh, positions).distances(VertexId(order[3]));
  for (int v = 0; v < n; ++v) EXPECT_NEAR(distances[order[v]], expected[v], kRound);
}

// Property: a metric. Every pair both ways, and a seeded choice of triples.
TEST(ExactGeodesics, AreAMetric) {
  const test::Surface surface = test::leaf(6, {.depth = 0.5, .bumps = 0.3, .seed = 11});
  const int n = surface.mesh.num_vertices();
  const std::vector<VertexId> all = all_vertices(surface.mesh);
  const Eigen::MatrixXd d = geodesic_distances(surface.mesh, surface.positions, all, GeodesicMethod::exact);
  EXPECT_LT((d - d.transpose()).cwiseAbs().maxCoeff(), kRound);
  Random random(12, "triples");
  for (int i = 0; i < 20000; ++i) {
    const int a = random.index(n), b = random.index(n), c = random.index(n);
    ASSERT_LE(d(a, c), d(a, b) + d(b, c) + kRound) << "seed 12: " << a << " " << b << " " << c;
  }
}

TEST(ExactGeodesics, PathsAreAsLongAsDistances) {
  expect_paths_fit(test::leaf(9, {.bumps = 0.1}), VertexId(0));
  expect_paths_fit(test::leaf(12, {.bumps = 0.3, .hole = true, .seed = 3}), VertexId(60));
}

// Differential: a search that is bounded to a band around the path finds the same; one that leaves the target
// out finds nothing.
TEST(ExactGeodesics, FindTheSamePathInABand) {
  const test::Surface surface = test::leaf(12, {.depth = 0.5, .bumps = 0.1, .seed = 4});
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  const VertexId source(0);
  const Eigen::VectorXd from_source = geodesics.distances(source);
  for (const int target : {100, 250, surface.mesh.num_vertices() - 1}) {
    const SurfacePath path = geodesics.paths(source, {VertexId(target)})[0];
    const Eigen::VectorXd sum = from_source + geodesics.distances(VertexId(target));
    std::vector<char> within(surface.mesh.num_vertices());
    for (const VertexId v : surface.mesh.vertices()) within[v] = sum[v] <= path.length + 0.1 ? 1 : 0;
    EXPECT_LT(std::accumulate(within.begin(), within.end(), 0), surface.mesh.num_vertices() / 2);
    const SurfacePath same = geodesics.paths(source, {VertexId(target)}, within)[0];
    ASSERT_EQ(same.points.size(), path.points.size()) << target;
    EXPECT_EQ(same.length, path.length) << target;
    within.assign(within.size(), 0);
    EXPECT_TRUE(geodesics.paths(source, {VertexId(target)}, within)[0].points.empty());
  }
}

// Oracle: a path through flat faces and along edges is the straight segment, each point on it.
TEST(ExactGeodesics, PathsOnAFlatMeshAreSegments) {
  const test::Surface surface = test::grid(8, 8);
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  const SurfacePath along = geodesics.paths(VertexId(0), {VertexId(8)})[0];  // the lower side
  EXPECT_EQ(along.points.size(), 9u);
  EXPECT_NEAR(along.length, 1.0, kRound);
  const SurfacePath slanted = geodesics.paths(VertexId(0), {VertexId(8 + 9 * 5)})[0];
  for (const SurfacePoint& p : slanted.points) {
    const Vec3 q = position(surface.mesh, surface.positions, p);
    EXPECT_NEAR(q.y(), 0.625 * q.x(), kRound);
  }
}

// Negative: what cannot be answered is said.
TEST(ExactGeodesics, NameBadInput) {
  const test::Surface surface = test::grid(2, 2);
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  EXPECT_THROW(geodesics.distances(VertexId(9)), Error);
  EXPECT_THROW(geodesics.distances(VertexId()), Error);
  EXPECT_THROW(geodesics.paths(VertexId(0), {VertexId(-1)}), Error);
  const Points3 few = surface.positions.topRows(3);
  EXPECT_THROW(ExactGeodesics(surface.mesh, few), Error);
  Points3 flat = surface.positions;
  flat.setZero();
  EXPECT_THROW(ExactGeodesics(surface.mesh, flat), Error);

  Faces faces(2, 3);
  faces << 0, 1, 2, 3, 4, 5;
  Points3 positions(6, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  const SurfaceMesh two(6, faces);
  const ExactGeodesics parts(two, positions);
  EXPECT_TRUE(std::isinf(parts.distances(VertexId(0))[4]));
  EXPECT_THROW(parts.paths(VertexId(0), {VertexId(4)}), Error);
}

}  // namespace
}  // namespace wilt
