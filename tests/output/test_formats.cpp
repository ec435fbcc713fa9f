// What the formats' writers promise beyond positions, and what assimp finds in OBJ and PLY.
#include <gtest/gtest.h>
#include <unistd.h>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <filesystem>

#include "output/sample_leaf.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/ply.hpp"
#include "wilt/output/point_cache.hpp"
#include "wilt/output/usd.hpp"
#include "wilt/output/vtk.hpp"
#include "wilt/simulation/uv_raster.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;

class Formats : public testing::Test {
 protected:
  Formats() : folder_(fs::temp_directory_path() / ("wilt_formats_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Formats() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Per vertex the positions of the sample's last frame, whichever order a reader has them in.
  double distance_to_blade(const aiVector3D& point) const {
    const Vec3 p(point.x, point.y, point.z);
    return (expected_.rowwise() - p.transpose()).rowwise().norm().minCoeff();
  }

  fs::path folder_;
  test::Sample sample_;
  Points3 expected_ = file_points(sample_.leaf.placement, sample_.frames.back().positions);
};

// A texture of 64 texels on a side, grey 0.5 on the left and 0.2 on the right (linear), as a PNG.
std::string halves() {
  Image image{64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const double linear = i % 64 < 32 ? 0.5 : 0.2;
    image.rgb.insert(image.rgb.end(), 3, static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(linear))));
  }
  return encode_png(image);
}

// Oracle: assimp's reader. It splits vertices, so every one of its vertices is looked for among ours.
TEST_F(Formats, AssimpReadsTheObjWithItsMaterial) {
  Clip clip = sample_.clip();
  clip.texture = halves();
  const ShownColours shown(clip);
  write_obj(path("leaf.obj"), shown, shown.last_frame());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("leaf.obj"), aiProcess_ValidateDataStructure);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2U);
  const aiMesh& blade = *scene->mMeshes[0];
  EXPECT_EQ(blade.mNumFaces, static_cast<unsigned>(sample_.leaf.mesh.num_faces()));
  double error = 0.0;
  for (unsigned v = 0; v < blade.mNumVertices; ++v)
    error = std::max(error, distance_to_blade(blade.mVertices[v]));
  std::printf("sample: OBJ + MTL  assimp  largest error of a position %.1e of 0.1\n", error);
  EXPECT_LT(error, 1e-8);  // float32 of 0.1 m
  ASSERT_TRUE(blade.HasTextureCoords(0));
  const aiMaterial& material = *scene->mMaterials[blade.mMaterialIndex];
  aiString texture;
  ASSERT_EQ(material.GetTexture(aiTextureType_DIFFUSE, 0, &texture), aiReturn_SUCCESS);
  EXPECT_STREQ(texture.C_Str(), "leaf.texture.jpg");
  aiColor3D colour;
  material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  EXPECT_EQ(colour, aiColor3D(1.0F));
  const aiMaterial& stalk = *scene->mMaterials[scene->mMeshes[1]->mMaterialIndex];
  stalk.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  EXPECT_NEAR(colour.r, encode_srgb(0.5), 1e-4);
  EXPECT_NEAR(colour.b, encode_srgb(0.2), 1e-4);
}

// Oracle: assimp's reader, which `wilt leaf` reads meshes with.
TEST(Glb, IsReadAgainAsAMesh) {
  test::Sample sample;
  test::hold_most(sample);
  const std::string bytes = glb_bytes(sample.clip());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2U);
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces, static_cast<unsigned>(sample.leaf.mesh.num_faces()));
}

// Oracle: assimp's reader; the sample's colours.
TEST_F(Formats, AssimpReadsThePlyWithItsColours) {
  const Clip clip = sample_.clip();
  const ShownColours shown(clip);
  write_ply(path("leaf.ply"), shown, shown.last_frame());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("leaf.ply"), aiProcess_ValidateDataStructure);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1U);
  const aiMesh& mesh = *scene->mMeshes[0];
  const std::size_t size = sample_.leaf.skin.vertex.size();
  ASSERT_GT(mesh.mNumVertices, size);
  ASSERT_TRUE(mesh.HasVertexColors(0) && mesh.HasNormals() && mesh.HasTextureCoords(0));
  double error = 0.0;
  for (std::size_t s = 0; s < size; ++s) {
    const int v = sample_.leaf.skin.vertex[s];
    const aiVector3D& p = mesh.mVertices[s];
    error = std::max(error, (Vec3(p.x, p.y, p.z) - expected_.row(v).transpose()).norm());
    EXPECT_NEAR(mesh.mColors[0][s].g, encode_srgb(clip.colours.back()(v, 1)), 1.0 / 255.0);
    EXPECT_NEAR(mesh.mTextureCoords[0][s].y, 1.0 - sample_.leaf.skin.uv(int(s), 1), 1e-6);
  }
  std::printf("sample: PLY        assimp  largest error of a position %.1e of 0.1\n", error);
  EXPECT_LT(error, 1e-8);
}

// Oracle: the sample is symmetric about its midrib, and the texture two plain halves: the mean around a
// vertex away from the border is its half's; texture x colour holds at every vertex and texel.
TEST_F(Formats, ColoursAreTextureTimesVertexColour) {
  Clip clip = sample_.clip();
  clip.texture = halves();
  for (Points3& colours : clip.colours) {  // from edge to edge of what a colour can be
    colours.col(0) = 0.2 + 6.0 * sample_.leaf.positions.col(1).array();
    colours.col(1) = 0.9 - 6.0 * sample_.leaf.positions.col(1).array();
  }
  const ShownColours shown(clip);
  for (const int frame : {0, 3}) {
    const Points3 found = shown.blade(frame);
    for (int v = 0; v < found.rows(); ++v) {
      const double x = sample_.leaf.positions(v, 0);
      if (std::abs(x) < 0.015) continue;
      const double grey = x < 0.0 ? 0.5 : 0.2;
      // Half a step of the texture's eight bits at 0.5.
      EXPECT_LT((found.row(v) - grey * clip.colours[frame].row(v)).cwiseAbs().maxCoeff(), 0.0034) << v;
    }
  }
  const Image picture = decode_image(shown.texture(3));
  ASSERT_EQ(picture.width, 64);
  const auto raster = uv_raster(sample_.leaf.skin, 64);
  for (const int v : {8, 12, 36, 40}) {
    const Vec2 uv = sample_.leaf.skin.uv.row(v).transpose();
    const std::uint8_t* rgb = picture.pixel(int(uv.x() * 64), int(uv.y() * 64));
    const double grey = sample_.leaf.positions(v, 0) < 0.0 ? 0.5 : 0.2;
    for (int c = 0; c < 3; ++c)  // JPEG keeps plain colours within a few steps; a texel is half an edge wide
      EXPECT_NEAR(decode_srgb(rgb[c] / 255.0), grey * clip.colours[3](v, c), 0.02) << v << ' ' << c;
  }
}

// Oracle: the clip's own: white without a texture and colours.
TEST_F(Formats, AClipWithoutColoursIsWhite) {
  const Clip bare{sample_.leaf, sample_.frames};
  const ShownColours shown(bare);
  EXPECT_EQ(shown.blade(2), Points3::Ones(sample_.leaf.mesh.num_vertices(), 3));
  EXPECT_EQ(shown.stalk(2), Vec3::Ones());
  EXPECT_EQ(shown.texture(2), "");
}

// Oracle: the names by hand.
TEST(Beside, SequencesAreNumberedInTheirHashes) {
  EXPECT_EQ(sequence_path("a/leaf.####.obj", 7), "a/leaf.0007.obj");
  EXPECT_EQ(sequence_path("leaf_#.ply", 12), "leaf_12.ply");
  EXPECT_EQ(sequence_stem("a/leaf.####.obj"), "a/leaf.obj");
  EXPECT_EQ(sequence_stem("a/####.obj"), "a/frames.obj");
  EXPECT_FALSE(is_sequence("a#b/leaf.obj"));
  EXPECT_TRUE(is_sequence("a#b/leaf.#.obj"));
  for (const char* wrong : {"leaf.obj", "#leaf#.obj", "##########.obj"})
    EXPECT_THROW(check_sequence(wrong), Error) << wrong;
  EXPECT_EQ(beside("a.b/leaf.v2.obj", ".mtl"), "a.b/leaf.v2.mtl");
}

// Oracle: the files of a longer sequence, byte for byte; each of ours is there.
TEST_F(Formats, ASequenceLeavesALongerOneAlone) {
  write_file(path("leaf.0005.obj"), "older");
  const Clip clip = sample_.clip();
  const ShownColours shown(clip);
  write_obj_sequence(path("leaf.####.obj"), shown);
  EXPECT_EQ(read_file(path("leaf.0005.obj")), "older");
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(fs::exists(path("leaf.000" + std::to_string(k) + ".obj"))) << k;
  EXPECT_TRUE(fs::exists(path("leaf.mtl")));
}

// Oracle: names and configuration that break quotes, comments and fences; independent readers have the rest.
TEST_F(Formats, OddNamesDoNotBreakTheText) {
  Clip clip = sample_.clip();
  clip.config = R"({"species": "a--b\"c"})";
  const ShownColours shown(clip);
  const std::string usd = usd_text(shown, {}, {path("a@b.texture.jpg"), ""});
  EXPECT_NE(usd.find("@@@./a@b.texture.jpg@@@"), std::string::npos);
  EXPECT_NE(usd.find(R"({\"species\": \"a--b\\\"c\"})"), std::string::npos);
  const std::string vtu = vtu_blade(shown, 0);
  const std::size_t begin = vtu.find("<!--") + 4;
  EXPECT_EQ(vtu.substr(begin, vtu.find("-->") - begin).find("--"), std::string::npos);
}

TEST_F(Formats, RefuseOptionsThatMakeNoSense) {
  Clip clip = sample_.clip();
  clip.texture = halves();
  const ShownColours shown(clip);
  for (const auto change :
       {+[](ClipOptions& o) { o.seconds = 0.0; }, +[](ClipOptions& o) { o.frame_rate = -1.0; },
        +[](ClipOptions& o) { o.hours_per_iteration = std::nan(""); },
        +[](ClipOptions& o) { o.stalk_sides = 2; }}) {
    ClipOptions options;
    change(options);
    EXPECT_THROW(usd_text(shown, options), Error);
    EXPECT_THROW(obj_text(clip, 0, {}, options), Error);
    EXPECT_THROW(ply_bytes(shown, 0, options), Error);
    EXPECT_THROW(vtu_blade(shown, 0, options), Error);
    EXPECT_THROW(write_point_caches(path("leaf.pc2"), clip, options), Error);
    EXPECT_THROW(write_obj(path("leaf.obj"), shown, 0, options), Error);
    EXPECT_THROW(write_usd(path("leaf.usda"), shown, options), Error);
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace wilt
