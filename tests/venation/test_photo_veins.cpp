// Ridge maps that are drawn here, so that the veins in them are known.
#include "wilt/venation/photo_veins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "wilt/core/random.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

constexpr int kSize = 448;

Vec2 uv_of(const Leaf& leaf, VertexId vertex) {
  return leaf.skin.uv.row(int(vertex)).transpose();  // a built-in leaf has no seams
}

struct Drawing {
  std::vector<float> strength;

  // Texels under a face of the blade are 0, the others -1; `noise` is the largest strength of what is no
  // vein.
  Drawing(const Leaf& leaf, double noise) : strength(kSize * kSize, -1.0f) {
    Random random(5, "ridges");
    for (int f = 0; f < leaf.skin.faces.rows(); ++f) {
      const Vec2 a = kSize * leaf.skin.uv.row(leaf.skin.faces(f, 0)).transpose(),
                 u = kSize * leaf.skin.uv.row(leaf.skin.faces(f, 1)).transpose() - a,
                 v = kSize * leaf.skin.uv.row(leaf.skin.faces(f, 2)).transpose() - a;
      const int steps = 2 * static_cast<int>(std::ceil(std::max(u.norm(), v.norm())));
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          const Vec2 p = a + (i * u + j * v) / steps;
          strength[std::size_t(int(p.y()) * kSize + int(p.x()))] =
              static_cast<float>(noise * random.uniform());
        }
    }
  }

  bool holds(const std::vector<Vec2>& line) const {
    return std::all_of(line.begin(), line.end(), [this](const Vec2& p) {
      return strength[std::size_t(int(kSize * p.y()) * kSize + int(kSize * p.x()))] >= 0.0f;
    });
  }

  void draw(const std::vector<Vec2>& line) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const int steps = static_cast<int>(2 * kSize * (line[k + 1] - line[k]).norm()) + 1;
      for (int i = 0; i <= steps; ++i) {
        const Vec2 p = kSize * (line[k] + (line[k + 1] - line[k]) * i / steps);
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            float& here = strength[std::size_t((int(p.y()) + dy) * kSize + int(p.x()) + dx)];
            if (here >= 0.0f) here = 1.0f;
          }
      }
    }
  }
};

// From one place to another by a bow to the side, which no shortest way takes.
std::vector<Vec2> bow(const Vec2& from, const Vec2& to, double height) {
  const Vec2 across(-(to - from).y(), (to - from).x());
  std::vector<Vec2> line;
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    line.push_back(from + t * (to - from) + height * 4.0 * t * (1.0 - t) * across);
  }
  return line;
}

double distance_to(const std::vector<Vec2>& line, const Vec2& p) {
  double least = 1e9;
  for (const Vec2& q : line) least = std::min(least, (q - p).norm());
  return least;
}

Vec2 uv_at(const Leaf& leaf, const SurfacePoint& point) {
  Vec2 uv = Vec2::Zero();
  for (int c = 0; c < 3; ++c)
    uv += point.barycentric[c] * leaf.skin.uv.row(leaf.skin.faces(int(point.face), c)).transpose();
  return uv;
}

void give(Leaf& leaf, const Drawing& drawing) {
  const auto photo = std::make_shared<LeafPhoto>();
  photo->ridges = {kSize, drawing.strength};
  leaf.photo = photo;
}

class PhotoVeins : public testing::Test {
 protected:
  PhotoVeins() : leaf(make_leaf("maple", 2000, 1)), shape(find_venation(leaf, species("maple").secondary)) {}
  Leaf leaf;
  Venation shape;
};

// Oracle: the lines that were drawn; a texel is 1/448 of the picture, a mesh edge 1/40.
TEST_F(PhotoVeins, FollowTheRidgesThatAreDrawn) {
  Drawing drawing(leaf, 0.3);
  const Vec2 petiole = uv_of(leaf, leaf.petiole);
  std::vector<std::vector<Vec2>> lines;
  for (const Tip& tip : shape.tips) {
    lines.push_back(bow(petiole, uv_of(leaf, tip.vertex), 0.05));
    if (!drawing.holds(lines.back())) lines.back() = bow(petiole, uv_of(leaf, tip.vertex), -0.05);
    if (!drawing.holds(lines.back())) lines.back() = bow(petiole, uv_of(leaf, tip.vertex), 0.0);
  }
  for (const auto& line : lines) drawing.draw(line);
  give(leaf, drawing);
  const Venation found = find_venation(leaf, species("maple").secondary);
  EXPECT_TRUE(found.from_photo);
  ASSERT_EQ(found.tips.size(), shape.tips.size());
  const auto farthest = [&](const Vein& vein, const std::vector<Vec2>& line) {
    double worst = 0.0;
    for (const SurfacePoint& point : vein.path.points)
      worst = std::max(worst, distance_to(line, uv_at(leaf, point)));
    return worst;
  };
  int bowed = 0, followed = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(found.tips[i].vertex, shape.tips[i].vertex);
    // Beside the petiole lines run side by side, and a way may change over.
    EXPECT_LT(farthest(found.veins[i], lines[i]), 0.03) << "tip " << i;
    followed += farthest(found.veins[i], lines[i]) < 0.015 ? 1 : 0;
    bowed += farthest(shape.veins[i], lines[i]) > 0.015 ? 1 : 0;
  }
  EXPECT_GE(followed, 6);
  EXPECT_GE(bowed, 4);  // the drawing is another one than the shape's
}

// Oracle: the drawing; a tooth whose vein leaves another one is no lobe, and its vein is a secondary one.
TEST_F(PhotoVeins, TellALobeFromABranch) {
  Drawing drawing(leaf, 0.2);
  const Vec2 petiole = uv_of(leaf, leaf.petiole);
  const std::size_t branch = 1;
  for (std::size_t i = 0; i < shape.tips.size(); ++i) {
    const Vec2 tip = uv_of(leaf, shape.tips[i].vertex);
    if (i != branch) drawing.draw(bow(petiole, tip, 0.0));
  }
  const Vec2 next = uv_of(leaf, shape.tips[branch + 1].vertex);
  drawing.draw(bow(petiole + 0.2 * (next - petiole), uv_of(leaf, shape.tips[branch].vertex), 0.0));
  give(leaf, drawing);
  const Venation found = find_venation(leaf, species("maple").secondary);
  EXPECT_EQ(found.tips.size(), shape.tips.size() - 1);
  const auto ends_at = [&](const Vein& vein) {
    return (uv_at(leaf, vein.path.points.back()) - uv_of(leaf, shape.tips[branch].vertex)).norm() < 0.02;
  };
  EXPECT_EQ(std::count_if(found.veins.begin(), found.veins.end(),
                          [&](const Vein& vein) { return vein.order == 2 && ends_at(vein); }),
            1);
}

// Differential: a photo that shows no veins changes nothing, and neither does one that is not to be used.
TEST_F(PhotoVeins, LeaveTheShapesVeinsWhereNoneAreShown) {
  give(leaf, Drawing(leaf, 0.4));
  EXPECT_TRUE(photo_veins(leaf, shape).empty());
  const Venation found = find_venation(leaf, species("maple").secondary);
  EXPECT_FALSE(found.from_photo);
  EXPECT_EQ(found.vein_distance, shape.vein_distance);
  Drawing clear(leaf, 0.0);
  clear.draw(bow(uv_of(leaf, leaf.petiole), uv_of(leaf, shape.tips[0].vertex), 0.05));
  give(leaf, clear);
  VenationOptions options;
  options.from_photo = false;
  EXPECT_EQ(find_venation(leaf, species("maple").secondary, options).vein_distance, shape.vein_distance);
}

}  // namespace
}  // namespace wilt
