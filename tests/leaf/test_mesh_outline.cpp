#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/random.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/outline.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

constexpr double kTwentyDegrees = 20.0 * std::numbers::pi / 180.0;

Points3 lifted(const Points2& points) {
  Points3 result = Points3::Zero(points.rows(), 3);
  result.leftCols<2>() = points;
  return result;
}

double angle_of(const PlanarMesh& planar) {
  return smallest_angle(planar.mesh, lifted(planar.positions));
}

double area_of(const PlanarMesh& planar) {
  return surface_area(planar.mesh, lifted(planar.positions));
}

double area_of(const Points2& ring) {
  double twice = 0.0;
  for (Eigen::Index i = 0; i < ring.rows(); ++i) {
    const Eigen::Index j = (i + 1) % ring.rows();
    twice += ring(i, 0) * ring(j, 1) - ring(i, 1) * ring(j, 0);
  }
  return std::abs(0.5 * twice);
}

int euler(const SurfaceMesh& mesh) {
  return mesh.num_vertices() - mesh.num_edges() + mesh.num_faces();
}

Points2 polar(int count, const std::function<double(double)>& radius) {
  Points2 points(count, 2);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    const double r = radius(angle);
    points.row(i) << r * std::cos(angle), r * std::sin(angle);
  }
  return points;
}

Points2 circle(double radius, int count = 2000) {
  return polar(count, [=](double) { return radius; });
}

PlanarMesh fill(const Outline& outline, int vertices, std::vector<Vec2> keep = {}) {
  MeshingOptions options;
  options.vertices = vertices;
  options.keep = std::move(keep);
  return mesh_outline(outline, options);
}

// Standard deviation of the edge lengths over their mean.
double unevenness(const PlanarMesh& planar) {
  const EdgeData<double> lengths = edge_lengths(planar.mesh, lifted(planar.positions));
  double mean = 0.0, square = 0.0;
  for (const double l : lengths.values()) mean += l / lengths.size();
  for (const double l : lengths.values()) square += (l - mean) * (l - mean) / lengths.size();
  return std::sqrt(square) / mean;
}

// Everything that is promised of any mesh: the count within 5 %, angles of 20 degrees, one disk with holes.
void expect_promises(const PlanarMesh& planar, int vertices, int holes, const std::string& what) {
  EXPECT_NEAR(planar.mesh.num_vertices(), vertices, 0.05 * vertices) << what;
  EXPECT_GE(angle_of(planar), kTwentyDegrees) << what;
  EXPECT_EQ(euler(planar.mesh), 1 - holes) << what;
  EXPECT_EQ(planar.mesh.boundary_loops().size(), static_cast<std::size_t>(1 + holes)) << what;
  EXPECT_GT(area_vector(planar.mesh, lifted(planar.positions)).z(), 0.0) << what;
}

// Property over species, sizes and seeds.
TEST(MeshOutline, KeepsItsPromisesForEverySpeciesSizeAndSeed) {
  for (const std::string& name : species_names()) {
    for (const int vertices : {200, 800, 2000, 5000}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const BladeOutline blade = blade_outline(name, seed);
        const PlanarMesh planar = fill(blade.outline, vertices, {blade.petiole});
        const std::string what = name + " " + std::to_string(vertices) + " seed " + std::to_string(seed);
        expect_promises(planar, vertices, 0, what);
        EXPECT_TRUE(planar.mesh.is_boundary(planar.kept[0])) << what;
        EXPECT_LT(unevenness(planar), 0.16) << what;  // 0.11 was the most seen, at 200 vertices
      }
    }
    const BladeOutline blade = blade_outline(name, 6);
    expect_promises(fill(blade.outline, 20000), 20000, 0, name + " 20000");
  }
}

TEST(MeshOutline, KeepsItsPromisesAtAHundredThousandVertices) {
  const PlanarMesh planar = fill(blade_outline("ivy", 1).outline, 100000);
  expect_promises(planar, 100000, 0, "ivy 100000");
  EXPECT_LT(unevenness(planar), 0.05);
}

// Oracle: the area of the disc. Smoothing with sigma = 0.6 h takes pi sigma^2 of it, chords pi h^2 / 6:
// about 1.7 h^2.
TEST(MeshOutline, FillsADiscToSecondOrder) {
  double last_error = 0.0, last_edge = 0.0;
  for (const int vertices : {500, 2000, 8000}) {
    const PlanarMesh planar = fill({circle(1.0, 6000), {}}, vertices);
    const double edge = mean_edge_length(planar.mesh, lifted(planar.positions));
    const double error = std::numbers::pi - area_of(planar);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 2.0 * edge * edge) << vertices;
    if (last_error > 0.0) {
      EXPECT_NEAR(std::log(last_error / error) / std::log(last_edge / edge), 2.0, 0.2) << vertices;
    }
    last_error = error;
    last_edge = edge;
  }
}

// Oracle: the area of the outline. An edge-wide strip is what the smoothing may change along a leaf's teeth;
// 0.04 of it is twice what was seen.
TEST(MeshOutline, FillsALeafUpToItsTeeth) {
  for (const std::string& name : species_names()) {
    const BladeOutline blade = blade_outline(name, 2);
    for (const int vertices : {800, 3000}) {
      const PlanarMesh planar = fill(blade.outline, vertices);
      const Points3 positions = lifted(planar.positions);
      const double strip = mean_edge_length(planar.mesh, positions) *
                           loop_length(positions, margin_loop(planar.mesh, positions));
      EXPECT_NEAR(area_of(planar), area_of(blade.outline.margin), 0.04 * strip) << name << " " << vertices;
    }
  }
}

// Oracle: the area of the ring, and Euler's formula; the error is that of two discs.
TEST(MeshOutline, KeepsHolesAndDropsThoseBelowAnEdge) {
  const Points2 hole = circle(0.4, 600);
  const PlanarMesh ring = fill({circle(1.0), {hole}}, 2000);
  expect_promises(ring, 2000, 1, "ring");
  const double edge = mean_edge_length(ring.mesh, lifted(ring.positions));
  EXPECT_NEAR(area_of(ring), std::numbers::pi * (1.0 - 0.16), 2.0 * edge * edge);
  expect_promises(fill({circle(1.0), {circle(0.005, 100)}}, 2000), 2000, 0, "pinprick");
}

TEST(MeshOutline, KeepsTheWantedPointsOnTheMargin) {
  const BladeOutline blade = blade_outline("maple", 1);
  std::vector<Vec2> keep{blade.petiole};
  keep.insert(keep.end(), blade.tips.begin(), blade.tips.end());
  for (const int vertices : {800, 5000, 20000}) {
    const PlanarMesh planar = fill(blade.outline, vertices, keep);
    ASSERT_EQ(planar.kept.size(), keep.size());
    const double edge = mean_edge_length(planar.mesh, lifted(planar.positions));
    for (std::size_t k = 0; k < keep.size(); ++k) {
      EXPECT_TRUE(planar.mesh.is_boundary(planar.kept[k])) << k;
      // A needle tip is blunted by about two edges.
      EXPECT_LT((planar.positions.row(planar.kept[k]).transpose() - keep[k]).norm(), 3.0 * edge) << k;
    }
  }
}

// Drawings and photos that nobody made for us: spikes, noise, necks and gaps thinner than an edge.
TEST(MeshOutline, CopesWithAwkwardOutlines) {
  Random random(7, "noise");
  std::vector<std::pair<std::string, Points2>> outlines;
  outlines.emplace_back(
      "needles", polar(4000, [](double a) { return 1 + 0.8 * std::pow(std::abs(std::cos(6 * a)), 40); }));
  outlines.emplace_back("noise", polar(4000, [&](double) { return 1 + 0.03 * random.normal(); }));
  Points2 square(4, 2), sliver(3, 2), dumbbell(12, 2), slit(7, 2);
  square << 0, 0, 1, 0, 1, 1, 0, 1;
  sliver << 0, 0, 1, 0, 1, 0.01;
  const double w = 0.002;
  dumbbell << -1, -.5, -.2, -.5, -.2, -w, .2, -w, .2, -.5, 1, -.5, 1, .5, .2, .5, .2, w, -.2, w, -.2, .5, -1,
      .5;
  slit << -1, -1, 1, -1, 1, 1, 0.0005, 1, 0, -.5, -0.0005, 1, -1, 1;
  outlines.emplace_back("square", square);
  outlines.emplace_back("sliver", sliver);
  outlines.emplace_back("dumbbell", dumbbell);
  outlines.emplace_back("slit", slit);
  for (const auto& [name, ring] : outlines) {
    for (const int vertices : {200, 1000, 4000}) {
      expect_promises(fill({ring, {}}, vertices), vertices, 0, name + " " + std::to_string(vertices));
    }
  }
}

// Invariance: a power of two scales every step exactly.
TEST(MeshOutline, ScalesWithTheOutline) {
  Outline outline = blade_outline("grape", 1).outline;
  const PlanarMesh one = fill(outline, 1000);
  outline.margin *= 1024.0;
  const PlanarMesh large = fill(outline, 1000);
  ASSERT_EQ(one.mesh.face_matrix(), large.mesh.face_matrix());
  EXPECT_NEAR((one.positions * 1024.0 - large.positions).cwiseAbs().maxCoeff(), 0.0, 1e-9);  // round-off
}

TEST(MeshOutline, DoesNotDependOnOrientationOrThreads) {
  Outline outline = blade_outline("tilia", 1).outline;
  const PlanarMesh one = fill(outline, 3000);
  {
    const ThreadLimit limit(1);
    const PlanarMesh serial = fill(outline, 3000);
    EXPECT_EQ(one.positions, serial.positions);
    EXPECT_EQ(one.mesh.face_matrix(), serial.mesh.face_matrix());
  }
  outline.margin = outline.margin.colwise().reverse().eval();
  expect_promises(fill(outline, 3000), 3000, 0, "clockwise");
}

// Neighbours in the mesh are neighbours in memory: the mean distance of indices along edges would be a third
// of the vertices in random order.
TEST(MeshOutline, OrdersVerticesForLocality) {
  const PlanarMesh planar = fill({circle(1.0), {}}, 5000);
  double apart = 0.0;
  const Edges edges = planar.mesh.edge_matrix();
  for (Eigen::Index e = 0; e < edges.rows(); ++e) apart += std::abs(edges(e, 0) - edges(e, 1));
  EXPECT_LT(apart / static_cast<double>(edges.rows()), 150.0);
}

TEST(MeshOutline, RefusesWhatItCannotDo) {
  const auto code_of = [](const Outline& outline, const MeshingOptions& options,
                          const Monitor& monitor = {}) {
    try {
      mesh_outline(outline, options, monitor);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::output;  // none of those expected
  };
  const Outline disc{circle(1.0, 100), {}};
  MeshingOptions options;
  options.vertices = 199;
  EXPECT_EQ(code_of(disc, options), ErrorCode::configuration);
  options.vertices = 1000001;
  EXPECT_EQ(code_of(disc, options), ErrorCode::configuration);
  options.vertices = 500;
  options.smallest_angle = 0.6;
  EXPECT_EQ(code_of(disc, options), ErrorCode::configuration);
  options.smallest_angle = 0.35;
  EXPECT_EQ(code_of({Points2::Zero(5, 2), {}}, options), ErrorCode::input);
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  EXPECT_EQ(code_of(disc, options, monitor), ErrorCode::interrupted);
}

}  // namespace
}  // namespace wilt
