#include <gtest/gtest.h>

#include <sstream>

#include "output/sample_leaf.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

/// The lines of an OBJ by keyword.
struct Parsed {
  std::vector<Vec3> v, vn;
  std::vector<Vec2> vt;
  std::vector<std::array<std::string, 3>> f;
  std::vector<std::string> objects;
  std::string comments;
};

Parsed parse(const std::string& text) {
  Parsed parsed;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    Vec3 row = Vec3::Zero();
    if (keyword == "v" || keyword == "vn") {
      words >> row[0] >> row[1] >> row[2];
      (keyword == "v" ? parsed.v : parsed.vn).push_back(row);
    } else if (keyword == "vt") {
      words >> row[0] >> row[1];
      parsed.vt.emplace_back(row[0], row[1]);
    } else if (keyword == "f") {
      auto& corners = parsed.f.emplace_back();
      words >> corners[0] >> corners[1] >> corners[2];
    } else if (keyword == "o") {
      parsed.objects.push_back(line.substr(2));
    } else if (keyword == "#") {
      parsed.comments += line;
    } else {
      ADD_FAILURE() << "unknown line: " << line;
    }
  }
  return parsed;
}

// Oracle: the leaf, nine digits (each number within 5e-9 of its size); texture coordinates turned bottom
// left.
TEST(Obj, HoldsTheMeshWithItsSeam) {
  Leaf leaf = test::sample_leaf();
  leaf.placement = test::sample_placement();
  const std::vector<Frame> frames = test::sample_frames(leaf);
  const Frame& frame = frames[3];
  const Parsed obj = parse(obj_text({leaf, frames}, 3));
  EXPECT_EQ(obj.objects, (std::vector<std::string>{"blade", "stalk"}));
  const int vertices = leaf.mesh.num_vertices(), faces = leaf.mesh.num_faces();
  const Points3 expected = file_points(leaf.placement, frame.positions);
  const Points3 normals = file_normals(leaf.placement, vertex_normals(leaf.mesh, frame.positions));
  for (int v = 0; v < vertices; ++v) {
    EXPECT_LT((obj.v.at(v) - expected.row(v).transpose()).norm(), 1e-8 * expected.cwiseAbs().maxCoeff());
    EXPECT_LT((obj.vn.at(v) - normals.row(v).transpose()).norm(), 1e-8);
  }
  ASSERT_EQ(obj.vt.size(), leaf.skin.vertex.size());
  for (int s = 0; s < leaf.skin.uv.rows(); ++s)
    EXPECT_LT((obj.vt[s] - Vec2(leaf.skin.uv(s, 0), 1.0 - leaf.skin.uv(s, 1))).norm(), 2e-9);
  for (int f = 0; f < faces; ++f) {
    for (int c = 0; c < 3; ++c) {
      int v = 0, vt = 0, vn = 0;
      ASSERT_EQ(std::sscanf(obj.f.at(f)[c].c_str(), "%d/%d/%d", &v, &vt, &vn), 3);
      EXPECT_EQ(v - 1, leaf.mesh.face_matrix()(f, c));
      EXPECT_EQ(vn, v);
      EXPECT_EQ(vt - 1, leaf.skin.faces(f, c));
    }
  }
}

// Oracle: indices. The stalk's faces refer to vertices after the blade's, every one of them.
TEST(Obj, StalkFollowsTheBlade) {
  const Leaf leaf = test::sample_leaf();
  const std::vector<Frame> frames = rest_frames(leaf);
  ClipOptions options;
  options.stalk_sides = 6;
  const Parsed obj = parse(obj_text({leaf, frames}, 0, {}, options));
  const int blade = leaf.mesh.num_vertices(), all = static_cast<int>(obj.v.size());
  EXPECT_EQ(all - blade, 5 * 6 + 2 * 7);
  EXPECT_EQ(obj.vn.size(), obj.v.size());
  int lowest = all + 1, highest = 0;
  for (std::size_t f = static_cast<std::size_t>(leaf.mesh.num_faces()); f < obj.f.size(); ++f) {
    for (const std::string& corner : obj.f[f]) {
      int v = 0, vn = 0;
      ASSERT_EQ(std::sscanf(corner.c_str(), "%d//%d", &v, &vn), 2);
      EXPECT_EQ(v, vn);
      lowest = std::min(lowest, v);
      highest = std::max(highest, v);
    }
  }
  EXPECT_EQ(lowest, blade + 1);
  EXPECT_EQ(highest, all);
}

TEST(Obj, StatesUnitsAndDirection) {
  Leaf leaf = test::sample_leaf();
  const std::vector<Frame> frames = rest_frames(leaf);
  EXPECT_NE(parse(obj_text({leaf, frames}, 0)).comments.find("units: metres, up: Y"), std::string::npos);
  leaf.placement.scale = 1000.0;
  EXPECT_NE(parse(obj_text({leaf, frames}, 0)).comments.find("units: 0.001 metres"), std::string::npos);
  leaf.stalk = {};
  const std::vector<Frame> bare = rest_frames(leaf);
  EXPECT_EQ(parse(obj_text({leaf, bare}, 0)).objects, std::vector<std::string>{"blade"});
}

// Oracle: the sample's three veins of 3, 2 and 2 points, numbered through.
TEST(VeinsObj, HoldsAPolylinePerVein) {
  const Leaf leaf = test::sample_leaf();
  const std::string text = veins_obj(leaf, test::sample_venation(leaf));
  EXPECT_NE(text.find("o primary_1\n"), std::string::npos);
  EXPECT_NE(text.find("o secondary_3\n"), std::string::npos);
  EXPECT_NE(text.find("\nl 1 2 3\n"), std::string::npos);
  EXPECT_NE(text.find("\nl 4 5\n"), std::string::npos);
  EXPECT_NE(text.find("\nl 6 7\n"), std::string::npos);
}

}  // namespace
}  // namespace wilt
