// The baked texture and its raster.
#include "wilt/simulation/leaf_texture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/meshes.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/simulation/uv_raster.hpp"

namespace wilt {
namespace {

// A unit square of two triangles, u to the right, v down.
Skin square_skin() {
  Skin skin;
  skin.uv.resize(4, 2);
  skin.uv << 0.25, 0.25, 0.75, 0.25, 0.75, 0.75, 0.25, 0.75;
  skin.faces.resize(2, 3);
  skin.faces << 0, 2, 1, 0, 3, 2;
  for (int v = 0; v < 4; ++v) skin.vertex.emplace_back(v);
  return skin;
}

// Oracle: analytic. A square from 1/4 to 3/4 covers the middle 32 x 32 of 64 x 64 texels, one triangle those
// above its diagonal.
TEST(UvRaster, CoversExactlyTheTexelsWhoseCentresAreInside) {
  const auto raster = uv_raster(square_skin(), 64);
  ASSERT_TRUE(raster);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int face = raster->face[static_cast<std::size_t>(64 * y + x)];
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 48;
      EXPECT_EQ(face >= 0, inside) << x << " " << y;
      if (inside && x != y) {
        EXPECT_EQ(face, x > y ? 0 : 1) << x << " " << y;
      }
    }
  }
}

// Oracle: analytic; the weights give the point back.
TEST(UvRaster, WeightsAreBarycentric) {
  const Skin skin = square_skin();
  const Vec2 p(0.6, 0.4);
  const Vec3 w = uv_weights(skin, 0, p);
  EXPECT_NEAR(w.sum(), 1.0, 1e-15);
  Vec2 back = Vec2::Zero();
  for (int c = 0; c < 3; ++c) back += w[c] * skin.uv.row(skin.faces(0, c)).transpose();
  EXPECT_LT((back - p).norm(), 1e-15);
}

// Negative: what cannot carry a picture of its own.
TEST(UvRaster, RefusesOverlapsAndWhatLeavesTheUnitSquare) {
  Skin overlapping = square_skin();
  overlapping.uv.row(3) << 0.80, 0.30;  // the second triangle folds over the first
  EXPECT_FALSE(uv_raster(overlapping, 64));
  Skin outside = square_skin();
  outside.uv(2, 0) = 1.2;
  EXPECT_FALSE(uv_raster(outside, 64));
  Skin none = square_skin();
  none.uv.resize(0, 2);
  EXPECT_FALSE(uv_raster(none, 64));
  Skin flat = square_skin();
  flat.uv.setZero();
  EXPECT_FALSE(uv_raster(flat, 64));
}

// Oracle: a picture of one colour stays one colour; of two halves, each side is filled with its own.
TEST(UvRaster, BleedsTheNearestColoursOutwards) {
  const auto raster = uv_raster(square_skin(), 50);  // not a power of two
  ASSERT_TRUE(raster);
  std::vector<std::uint8_t> rgb(3 * 50 * 50, 0);
  for (std::size_t i = 0; i < 2500; ++i) {
    if (raster->face[i] < 0) continue;
    rgb[3 * i] = i % 50 < 25 ? 200 : 100;
    rgb[3 * i + 1] = 60;
  }
  bleed(*raster, rgb);
  for (std::size_t i = 0; i < 2500; ++i) {
    EXPECT_EQ(rgb[3 * i + 1], 60) << i;
    EXPECT_GE(rgb[3 * i], 100);
  }
  EXPECT_EQ(rgb[3 * (25 * 50 + 11)], 200);
  EXPECT_EQ(rgb[3 * (25 * 50 + 38)], 100);
}

struct Case {
  Leaf leaf;
  Venation venation;
  Pigmentation pigments;
  SenescencePattern pattern;
};

Case make_case(const std::string& name) {
  Case c{make_leaf(name, 600, 1), {}, species(name).pigments, {}};
  c.venation = find_venation(c.leaf, species(name).secondary);
  c.pattern = senescence_pattern(c.leaf, c.venation, c.pigments);
  return c;
}

Image bake(const Case& c, double dryness, int size, const Vec3& gain = Vec3::Ones()) {
  const auto texels = BladeTexels::make(c.leaf, c.venation, size);
  if (!texels) return {};
  return leaf_texture(*texels, c.pattern, TissueColours(c.pigments),
                      Eigen::VectorXd::Constant(c.leaf.positions.rows(), dryness), gain);
}

// Mean linear colour of the covered texels.
Vec3 mean_colour(const Case& c, const Image& texture) {
  const auto raster = uv_raster(c.leaf.skin, texture.width);
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t i = 0; i < raster->face.size(); ++i) {
    if (raster->face[i] < 0) continue;
    sum += linear_rgb({texture.rgb[3 * i], texture.rgb[3 * i + 1], texture.rgb[3 * i + 2]});
    ++count;
  }
  return sum / count;
}

// Mean over the area of the blade of values at its vertices.
Vec3 mean_over_blade(const Case& c, const Points3& values) {
  const Faces faces = c.leaf.mesh.face_matrix();
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (int f = 0; f < faces.rows(); ++f) {
    const Vec3 a = c.leaf.positions.row(faces(f, 0)).transpose();
    const Vec3 ab = c.leaf.positions.row(faces(f, 1)).transpose() - a,
               ac = c.leaf.positions.row(faces(f, 2)).transpose() - a;
    const double area = ab.cross(ac).norm();
    for (int k = 0; k < 3; ++k) sum += area / 3.0 * values.row(faces(f, k)).transpose();
    total += area;
  }
  return sum / total;
}

// Oracle: the colours per vertex, whose mean over the blade the texture's mean must match: veins, spots and
// mottling move it by less than 13 of 255 in sRGB. This holds texture x COLOR_0 to the colour of a frame.
TEST(LeafTexture, HasTheColoursOfTheVerticesOnTheWhole) {
  for (const char* name : {"maple", "willow"}) {
    const Case c = make_case(name);
    for (const double dryness : {0.0, 0.5, 1.0}) {
      const Points3 vertices = leaf_colours(c.pattern, TissueColours(c.pigments),
                                            Eigen::VectorXd::Constant(c.leaf.positions.rows(), dryness));
      const Vec3 expected = mean_over_blade(c, vertices), found = mean_colour(c, bake(c, dryness, 256));
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(255.0 * encode_srgb(found[k]), 255.0 * encode_srgb(expected[k]), 13.0)
            << name << " " << dryness;
      }
    }
  }
}

// Oracle: the gain is a factor of linear light.
TEST(LeafTexture, GainMultipliesLinearLight) {
  const Case c = make_case("tilia");
  const Vec3 gain(1.5, 1.2, 2.0);
  const Vec3 plain = mean_colour(c, bake(c, 0.3, 128)), bright = mean_colour(c, bake(c, 0.3, 128, gain));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(bright[k] / plain[k], gain[k], 0.02);
}

// Oracle: a vein is paler than the tissue beside it: on the midrib a fresh texture is lighter than the mean.
TEST(LeafTexture, ShowsTheMidrib) {
  const Case c = make_case("tilia");
  const int size = 512;
  const Image texture = bake(c, 0.0, size);
  const Vec3 mean = mean_colour(c, texture);
  const auto& path = c.venation.veins.front().path.points;
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t i = path.size() / 8; i < path.size() / 2; ++i, ++count) {
    Vec2 uv = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
      uv += path[i].barycentric[k] * c.leaf.skin.uv.row(c.leaf.skin.faces(int(path[i].face), k)).transpose();
    const std::size_t texel =
        3 * (static_cast<std::size_t>(uv.y() * size) * size + static_cast<std::size_t>(uv.x() * size));
    sum += linear_rgb({texture.rgb[texel], texture.rgb[texel + 1], texture.rgb[texel + 2]});
  }
  ASSERT_GT(count, 5);
  EXPECT_GT((sum / count).y(), 1.15 * mean.y());
}

// Oracle: the bytes on one thread.
TEST(LeafTexture, GivesTheSameBytesOnAnyNumberOfThreads) {
  const Case c = make_case("grape");
  Image one;
  {
    const ThreadLimit limit(1);
    one = bake(c, 0.8, 200);
  }
  for (const int threads : {2, 3}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(bake(c, 0.8, 200).rgb, one.rgb);
  }
}

TEST(LeafTexture, IsEmptyWhenItCannotBe) {
  Case c = make_case("ivy");
  EXPECT_EQ(bake(c, 0.5, 0).width, 0);
  c.leaf.skin.uv.array() += 0.5;
  EXPECT_EQ(bake(c, 0.5, 64).width, 0);
}

}  // namespace
}  // namespace wilt
