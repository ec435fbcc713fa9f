// Colours and texture of a run in its GLB.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "wilt/core/image_codec.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/senescence.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

struct Case {
  Leaf leaf = make_leaf("grape", 500, 1);
  Config config = default_config(species("grape"));
  Venation venation = find_venation(leaf, species("grape").secondary);
  std::vector<Frame> frames;

  Case() {
    config.texture.size = 128;
    for (const int iteration : {0, 40, 100}) {
      Frame frame = rest_frames(leaf).front();
      frame.iteration = iteration;
      frame.dryness.setConstant(0.009 * iteration);
      frames.push_back(frame);
    }
  }
};

// Oracle: the colours of the states. COLOR_0 over COLOR_0 of the last frame is C_k over C_last, wherever
// nothing was clipped; the last COLOR_0 is one constant; a single-colour reader sees the last frame.
TEST(ClipOfARun, TextureTimesColourIsTheFramesColour) {
  const Case run;
  const Clip clip = make_clip(run.leaf, run.venation, run.config, run.frames);
  const Pigmentation& pigments = species("grape").pigments;
  const SenescencePattern pattern = senescence_pattern(run.leaf, run.venation, pigments);
  const TissueColours tissue(pigments);
  ASSERT_EQ(clip.colours.size(), 3u);
  const Points3& last = clip.colours.back();
  for (int v = 1; v < last.rows(); ++v) EXPECT_LT((last.row(v) - last.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE(last.maxCoeff(), 1.0);
  const Points3 dry = leaf_colours(pattern, tissue, run.frames.back().dryness);
  for (std::size_t k = 0; k < 3; ++k) {
    const Points3 state = leaf_colours(pattern, tissue, run.frames[k].dryness);
    for (int i = 0; i < state.size(); ++i) {
      const double shown = clip.colours[k].data()[i];
      EXPECT_GE(shown, 0.0);
      EXPECT_LE(shown, 1.0);
      if (shown < 1.0 && dry.data()[i] > 0.01 && state.data()[i] > 0.01) {
        EXPECT_NEAR(shown / last.data()[i], state.data()[i] / dry.data()[i], 1e-9);
      }
    }
  }
}

// Oracle: the bytes that were written; they are a picture of the size that was asked for, and frames come
// back from the file as given.
TEST(ClipOfARun, CarriesItsTextureThroughTheFile) {
  const Case run;
  const Clip clip = make_clip(run.leaf, run.venation, run.config, run.frames);
  const GlbFile file = parse_glb(glb_bytes(clip), "grape");
  EXPECT_EQ(file.texture, clip.texture);
  const Image picture = decode_image(file.texture);
  // Texture x COLOR_0 is the colour of each frame, on the whole: veins and spots move the mean by some
  // percent.
  const Pigmentation& pigments = species("grape").pigments;
  const auto raster = uv_raster(run.leaf.skin, 128);
  ASSERT_TRUE(raster);
  Vec3 texture = Vec3::Zero();
  int covered = 0;
  for (std::size_t i = 0; i < raster->face.size(); ++i) {
    if (raster->face[i] < 0) continue;
    texture += linear_rgb({picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]});
    ++covered;
  }
  const Points3 last = leaf_colours(senescence_pattern(run.leaf, run.venation, pigments),
                                    TissueColours(pigments), run.frames.back().dryness);
  const Vec3 factor = clip.colours.back().colwise().mean().transpose();
  for (int c = 0; c < 3; ++c) {
    const double shown = texture[c] / covered * factor[c], state = last.col(c).mean();
    EXPECT_NEAR(shown / state, 1.0, 0.25) << c;
  }
  EXPECT_EQ(picture.width, 128);
  EXPECT_EQ(picture.height, 128);
  ASSERT_EQ(file.meshes.front().colours.size(), 3u);
}

// Oracle: the colours of the states themselves.
TEST(ClipOfARun, HasColoursPerVertexWithoutATexture) {
  Case run;
  run.config.texture.size = 0;
  const Clip clip = make_clip(run.leaf, run.venation, run.config, run.frames);
  EXPECT_TRUE(clip.texture.empty());
  const Pigmentation& pigments = species("grape").pigments;
  EXPECT_EQ(clip.colours[1], leaf_colours(senescence_pattern(run.leaf, run.venation, pigments),
                                          TissueColours(pigments), run.frames[1].dryness));
}

// A photo over the leaf's texture coordinates: green to yellow from left to right, striped.
std::shared_ptr<const LeafPhoto> striped_photo() {
  constexpr int kSide = 200;
  LeafPhoto photo{{kSide, kSide, {}}, {Vec2::Zero(), Vec2(kSide, kSide)}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int stripe = y / 8 % 2 == 0 ? 25 : 0;
      for (const int byte : {50 + x / 2 + stripe, 110 + x / 4 + stripe, 20 + stripe})
        photo.image.rgb.push_back(static_cast<std::uint8_t>(byte));
    }
  }
  return std::make_shared<const LeafPhoto>(std::move(photo));
}

// Steps of 255 by which texture x first colours miss the photo in red and green, ascending.
std::vector<double> misses(const Leaf& leaf, const Clip& clip) {
  const Image texture = decode_image(clip.texture);
  const int size = texture.width;
  const auto raster = uv_raster(leaf.skin, size);
  std::vector<double> all;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int face = raster->face[static_cast<std::size_t>(y) * size + x];
      if (face < 0) continue;
      const Vec3 w = uv_weights(leaf.skin, face, {(x + 0.5) / size, (y + 0.5) / size});
      for (int c = 0; c < 2; ++c) {
        double first = 0.0;
        for (int k = 0; k < 3; ++k) first += w[k] * clip.colours.front()(leaf.skin.faces(face, k), c);
        const double shown = 255.0 * encode_srgb(decode_srgb(texture.pixel(x, y)[c] / 255.0) * first);
        all.push_back(std::abs(shown - leaf.photo->image.pixel(x, y)[c]));
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Oracle: the photo's own bytes; what a JPEG loses comes on top of what test_photo_tissue.cpp allows. The
// texture has the photo's size, and the colours do change.
TEST(ClipOfAPhoto, ShowsThePhotoAtRest) {
  Case run;
  run.leaf.photo = striped_photo();
  const Clip clip = make_clip(run.leaf, run.venation, run.config, run.frames);
  const std::vector<double> all = misses(run.leaf, clip);
  EXPECT_LT(all[all.size() / 2], 1.5);
  EXPECT_LT(all[all.size() * 99 / 100], 4.0);
  EXPECT_EQ(decode_image(clip.texture).width, 200);
  EXPECT_GT((clip.colours.back() - clip.colours.front()).cwiseAbs().maxCoeff(), 0.1);
  const GlbFile file = parse_glb(glb_bytes(clip), "photo");
  EXPECT_EQ(file.texture, clip.texture);
}

// Oracle: the same; a leaf that does not wither is the photo in white light.
TEST(ClipOfAPhoto, OfALeafAtRestIsThePhoto) {
  Case run;
  run.leaf.photo = striped_photo();
  const std::vector<Frame> rest = rest_frames(run.leaf);
  const Clip clip = make_clip(run.leaf, run.venation, run.config, rest);
  EXPECT_EQ(clip.colours.front(), Points3::Ones(run.leaf.positions.rows(), 3));
  const std::vector<double> all = misses(run.leaf, clip);
  EXPECT_LT(all[all.size() / 2], 1.5);
  EXPECT_LT(all[all.size() * 99 / 100], 4.0);
}

// Oracle: the photo's mean colour by side. Without a texture the photo's colours stand per vertex.
TEST(ClipOfAPhoto, ColoursVerticesWithoutATexture) {
  Case run;
  run.leaf.photo = striped_photo();
  run.config.texture.size = 0;
  const Clip clip = make_clip(run.leaf, run.venation, run.config, run.frames);
  EXPECT_TRUE(clip.texture.empty());
  for (int s = 0; s < run.leaf.skin.uv.rows(); ++s) {
    const Vec3 shown = clip.colours.front().row(run.leaf.skin.vertex[std::size_t(s)]).transpose();
    EXPECT_NEAR(255.0 * encode_srgb(shown.x()), 62.0 + 100.0 * run.leaf.skin.uv(s, 0), 16.0);
  }
}

}  // namespace
}  // namespace wilt
