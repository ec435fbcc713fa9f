// A photo's colours: kept at rest, aged from the state that the photo shows.
#include "wilt/simulation/photo_tissue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "wilt/core/parallel.hpp"
#include "wilt/core/random.hpp"
#include "wilt/core/srgb.hpp"

namespace wilt {
namespace {

constexpr int kSize = 256;

struct Case {
  Leaf leaf;
  Venation venation;
  SenescencePattern pattern;
  TissueColours colours;
  BladeTexels texels;

  explicit Case(const std::string& name)
      : leaf(make_leaf(name, 600, 1)),
        venation(find_venation(leaf, species(name).secondary)),
        pattern(senescence_pattern(leaf, venation, species(name).pigments)),
        colours(species(name).pigments),
        texels(*BladeTexels::make(leaf, venation, kSize)) {}

  PhotoTissue tissue(const Image& photo) const { return photo_tissue(texels, photo, pattern, colours); }
  Points3 aged(const PhotoTissue& tissue, double dryness) const {
    return aged_colours(tissue, pattern, colours, all(dryness));
  }
  Eigen::VectorXd all(double dryness) const {
    return Eigen::VectorXd::Constant(leaf.positions.rows(), dryness);
  }
};

Image painted(const std::function<Vec3(int x, int y)>& linear) {
  Image image{kSize, kSize, std::vector<std::uint8_t>(3 * kSize * kSize)};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3 colour = linear(x, y).cwiseMax(0.0).cwiseMin(1.0);
      for (int c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(colour[c])));
    }
  }
  return image;
}

Image uniform(const Vec3& colour) {
  return painted([&](int, int) { return colour; });
}

// Green leaf with veins four times as bright every 24 texels, and grain.
Image veined(const Vec3& colour) {
  Random random(5, "grain");
  return painted([&](int x, int y) -> Vec3 {
    const double vein = (x + y) % 24 < 2 ? 4.0 : 1.0;
    return vein * std::exp(0.15 * random.uniform(-1.0, 1.0)) * colour;
  });
}

double encoded(double linear) {
  return 255.0 * encode_srgb(std::clamp(linear, 0.0, 1.0));
}

// Calls visit(texel x, y, interpolated rows of values) for every covered texel.
void for_each_texel(const Case& c, const Points3& values,
                    const std::function<void(int x, int y, const Vec3& at)>& visit) {
  const UvRaster& raster = c.texels.raster();
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int face = raster.face[static_cast<std::size_t>(y) * kSize + x];
      if (face < 0) continue;
      const Vec3 w = uv_weights(c.leaf.skin, face, {(x + 0.5) / kSize, (y + 0.5) / kSize});
      Vec3 at = Vec3::Zero();
      for (int k = 0; k < 3; ++k) at += w[k] * values.row(c.leaf.skin.faces(face, k)).transpose();
      visit(x, y, at);
    }
  }
}

// Oracle: the photo's bytes. Whatever mean colours the texture is asked to have, as long as it can hold the
// photo: texture x first colour is the photo, within the steps that the header states and a rounding.
TEST(PhotoTexture, TimesTheFirstColourIsThePhoto) {
  const Case c("maple");
  const Image photo = veined({0.04, 0.09, 0.004});
  const PhotoTissue tissue = c.tissue(photo);
  Random random(3, "levels");
  PhotoLevels levels{tissue.colour, tissue.colour};
  for (int i = 0; i < levels.first.size(); ++i) {
    levels.first.data()[i] = random.uniform(0.4, 1.0);
    levels.texture.data()[i] *= random.uniform(1.0, 3.0);
  }
  const Image texture = photo_texture(c.texels, photo, tissue, levels, c.all(0.7));
  for_each_texel(c, levels.first, [&](int x, int y, const Vec3& first) {
    for (int k = 0; k < 3; ++k) {
      if (texture.pixel(x, y)[k] == 255) continue;
      const double shown = encoded(decode_srgb(texture.pixel(x, y)[k] / 255.0) * first[k]);
      EXPECT_NEAR(shown, photo.pixel(x, y)[k], k == 2 ? 6.1 : 2.1) << x << " " << y << " " << k;
    }
  });
}

// Oracle: differential, against the species' own ageing. A uniform photo of its fresh colour, rounded to
// eight bits, ages as the species does.
TEST(AgedColours, OfAPhotoOfTheFreshSpeciesAreTheSpecies) {
  for (const std::string& name : species_names()) {
    const Case c(name);
    const PhotoTissue tissue = c.tissue(uniform(c.colours({0.0, 0.0, 0.0})));
    for (const double dryness : {0.0, 0.3, 0.6, 1.0}) {
      const Points3 aged = c.aged(tissue, dryness),
                    expected = leaf_colours(c.pattern, c.colours, c.all(dryness));
      double most = 0.0;
      for (int i = 0; i < aged.size(); ++i)
        most = std::max(most, std::abs(encoded(aged.data()[i]) - encoded(expected.data()[i])));
      EXPECT_LT(most, 4.0) << name << " " << dryness;
    }
  }
}

// Oracle: the photo itself, bit by bit, and the order of colours. At rest nothing has changed; later no place
// is greener than it was and than dead tissue is (green over red), whatever the photo shows.
TEST(AgedColours, StartFromThePhotoAndNeverFreshen) {
  const Case c("grape");
  double dead_green = 0.0;
  for (double age = 0.6; age < 1.2; age += 0.05) {
    const Vec3 dead = c.colours({age, 0.0, 0.0});
    dead_green = std::max(dead_green, dead.y() / dead.x());
  }
  for (const Vec3& colour : {Vec3(0.06, 0.12, 0.002), Vec3(0.3, 0.4, 0.05), Vec3(0.5, 0.35, 0.1),
                             Vec3(0.12, 0.04, 0.001), Vec3(0.02, 0.015, 0.01), Vec3(0.3, 0.05, 0.06)}) {
    const PhotoTissue tissue = c.tissue(veined(colour));
    EXPECT_EQ(c.aged(tissue, 0.0), tissue.colour);
    for (const double dryness : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const Points3 aged = c.aged(tissue, dryness);
      EXPECT_LE(aged.maxCoeff(), 1.0);
      EXPECT_GT(aged.minCoeff(), 0.0);
      for (int v = 0; v < aged.rows(); ++v) {
        const double before = tissue.colour(v, 1) / tissue.colour(v, 0);
        EXPECT_LE(aged(v, 1) / aged(v, 0), 1.03 * std::max(before, dead_green))
            << colour.transpose() << " " << dryness;
      }
    }
  }
}

// Oracle: the species' dead colour, brighter and darker by the light. Such a photo is of old tissue and stays
// within a few steps of brown: no green and no yellow stage comes back.
TEST(AgedColours, OfADeadLeafStayDead) {
  const Case c("tilia");
  const Vec3 dead = c.colours({1.0, 0.0, 0.0});
  for (const double light : {0.7, 1.0, 1.3}) {
    const PhotoTissue tissue = c.tissue(uniform(light * dead));
    EXPECT_GT(tissue.age.minCoeff(), 0.7) << light;
    for (const double dryness : {0.3, 0.6, 1.0}) {
      const Points3 aged = c.aged(tissue, dryness);
      const double hue = aged.col(0).mean() / aged.col(1).mean();
      EXPECT_NEAR(hue, dead.x() / dead.y(), 0.12 * dead.x() / dead.y()) << light << " " << dryness;
      EXPECT_LT(aged.col(1).mean(), 1.1 * light * dead.y());
    }
  }
}

// Oracle: which half was painted green and which brown.
TEST(PhotoTissue, SeesWhereALeafIsAlreadyDead) {
  const Case c("grape");
  const Vec3 fresh = c.colours({0.0, 0.0, 0.0}), dead = c.colours({1.0, 0.0, 0.0});
  const PhotoTissue tissue = c.tissue(painted([&](int x, int) { return x < kSize / 2 ? fresh : dead; }));
  for (int s = 0; s < c.leaf.skin.uv.rows(); ++s) {
    const double u = c.leaf.skin.uv(s, 0), age = tissue.age[c.leaf.skin.vertex[std::size_t(s)]];
    if (u < 0.42) {
      EXPECT_LT(age, 0.15);
    }
    if (u > 0.58) {
      EXPECT_GT(age, 0.7);
    }
  }
}

// Oracle: correlation of the logarithms of both pictures' detail, green and red, over all texels: what this
// leaf has on it is still there when it is dry.
TEST(PhotoTexture, KeepsTheDetailOfTheLeaf) {
  const Case c("grape");
  const Image photo = veined({0.06, 0.12, 0.002});
  const PhotoTissue tissue = c.tissue(photo);
  const Points3 last = c.aged(tissue, 1.0);
  PhotoLevels levels;
  levels.first = tissue.colour.cwiseQuotient(last).cwiseMin(1.0);
  levels.texture = tissue.colour.cwiseQuotient(levels.first);
  const Image texture = photo_texture(c.texels, photo, tissue, levels, faded_hue(c.pattern, c.all(1.0)));
  for (int k = 0; k < 2; ++k) {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for_each_texel(c, levels.texture, [&](int x, int y, const Vec3& level) {
      const double after = std::log(decode_srgb(texture.pixel(x, y)[k] / 255.0) / level[k]);
      const double before = std::log(decode_srgb(photo.pixel(x, y)[k] / 255.0));
      n += 1, a += before, b += after, aa += before * before, bb += after * after, ab += before * after;
    });
    const double correlation = (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
    EXPECT_GT(correlation, 0.9) << k;
  }
}

// Oracle: the bytes on one thread.
TEST(PhotoTexture, IsTheSameOnAnyNumberOfThreads) {
  const Case c("ivy");
  const Image photo = veined({0.1, 0.2, 0.02});
  const auto make = [&] {
    const PhotoTissue tissue = c.tissue(photo);
    const Points3 last = c.aged(tissue, 0.8);
    return photo_texture(c.texels, photo, tissue, {tissue.colour.cwiseQuotient(last).cwiseMin(1.0), last},
                         faded_hue(c.pattern, c.all(0.8)));
  };
  Image one;
  {
    const ThreadLimit limit(1);
    one = make();
  }
  const ThreadLimit limit(3);
  EXPECT_EQ(make().rgb, one.rgb);
}

}  // namespace
}  // namespace wilt
