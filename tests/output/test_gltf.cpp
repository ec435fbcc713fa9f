#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/sample_leaf.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/version.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/glb_container.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/tube.hpp"

namespace wilt {
namespace {

using Json = nlohmann::json;
constexpr double kEps = std::numeric_limits<float>::epsilon();

Points3 of_skin(const Leaf& leaf, const Points3& of_vertices) {
  Points3 rows(static_cast<int>(leaf.skin.vertex.size()), 3);
  for (int s = 0; s < rows.rows(); ++s)
    rows.row(s) = of_vertices.row(leaf.skin.vertex[static_cast<std::size_t>(s)]);
  return rows;
}

// The message of the Error{input} that reading `bytes` throws.
std::string refusal(const std::string& bytes) {
  try {
    parse_glb(bytes, "some.glb");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("some.glb"), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "it was read";
  return "";
}

// The GLB with its JSON changed.
std::string changed(const std::string& bytes, const std::function<void(Json&)>& change) {
  const std::string_view text = glb_json(bytes, "");
  Json document = Json::parse(text);
  change(document);
  return join_glb(document.dump(), bytes.substr(20 + text.size() + 8));
}

// Oracle: what was written, within float32: two roundings of half an eps, of the base and the difference.
TEST(Glb, ReadsBackEveryFrame) {
  test::Sample sample;
  sample.leaf.placement = test::sample_placement();
  const Leaf& leaf = sample.leaf;
  const Clip clip = sample.clip();
  const GlbFile file = parse_glb(glb_bytes(clip), "sample");
  ASSERT_EQ(file.meshes.size(), 2U);
  const GlbMesh& blade = file.meshes[0];
  const GlbMesh& stalk = file.meshes[1];
  EXPECT_EQ(blade.name, "blade");
  EXPECT_EQ(stalk.name, "stalk");
  ASSERT_EQ(blade.frames.size(), sample.frames.size());
  ASSERT_EQ(stalk.frames.size(), sample.frames.size());
  ASSERT_EQ(blade.colours.size(), sample.frames.size());
  for (std::size_t k = 0; k < sample.frames.size(); ++k) {
    const Points3 expected = of_skin(leaf, file_points(leaf.placement, sample.frames[k].positions));
    EXPECT_LT((blade.frames[k] - expected).cwiseAbs().maxCoeff(), kEps * expected.cwiseAbs().maxCoeff());
    const Tube tube_there =
        tube(sample.frames[k].stalk, leaf.stalk.radii, 10, tube_reference(sample.frames[0].stalk));
    const Points3 there = file_points(leaf.placement, tube_there.positions);
    EXPECT_LT((stalk.frames[k] - there).cwiseAbs().maxCoeff(), kEps * there.cwiseAbs().maxCoeff());
    EXPECT_LT((blade.normals[k].rowwise().norm().array() - 1.0).abs().maxCoeff(), 4.0 * kEps);
  }
  EXPECT_EQ(blade.faces, leaf.skin.faces);
  EXPECT_LT((blade.uv - leaf.skin.uv).cwiseAbs().maxCoeff(), kEps);
  for (int s = 0; s < blade.water.size(); ++s)
    EXPECT_NEAR(blade.water[s],
                sample.frames.back().water_fraction[leaf.skin.vertex[static_cast<std::size_t>(s)]], kEps);
  EXPECT_EQ(file.iterations, (std::vector<int>{0, 10, 30, 60, 100}));
  EXPECT_EQ(file.generator, std::string("wilt ") + version());
}

// Oracle: analytic. Time is proportional to the iteration: 0, 10, 30, 60, 100 of 100 in 4 s.
TEST(Glb, KeyTimesAreProportionalToIterations) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip()), "sample");
  const std::vector<double> expected{0.0, 0.4, 1.2, 2.4, 4.0};
  ASSERT_EQ(file.times.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(file.times[k], expected[k], 4.0 * kEps);
}

// Oracle: analytic, for a point chosen by hand: (1, 2, 3) in metres, turned a quarter about z, doubled and
// moved by (10, 0, 0), is (6, 2, 6) with Z up and (6, 6, -2) with Y up.
TEST(Glb, AppliesThePlacementAndThenTurnsYUp) {
  Placement placement;
  placement.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  placement.scale = 2.0;
  placement.translation << 10, 0, 0;
  Points3 point(1, 3), normal(1, 3);
  point << 1, 2, 3;
  normal << 0, 1, 0;
  EXPECT_LT((file_points(placement, point) - Points3(Eigen::RowVector3d(6, 6, -2))).norm(), 1e-14);
  EXPECT_LT((file_normals(placement, normal) - Points3(Eigen::RowVector3d(-1, 0, 0))).norm(), 1e-14);
  EXPECT_EQ(unit_name(placement), "0.5 metres");
  EXPECT_EQ(unit_name({}), "metres");
}

// Oracle: the mesh. Both sides of a seam have one position and one normal, and two texture coordinates.
TEST(Glb, SeamVerticesStayTogether) {
  const test::Sample sample;
  const Leaf& leaf = sample.leaf;
  const GlbMesh blade = parse_glb(glb_bytes(sample.clip()), "sample").meshes[0];
  int pairs = 0;
  for (int s = leaf.mesh.num_vertices(); s < static_cast<int>(leaf.skin.vertex.size()); ++s, ++pairs) {
    const int twin = leaf.skin.vertex[static_cast<std::size_t>(s)];
    for (std::size_t k = 0; k < blade.frames.size(); ++k) {
      EXPECT_EQ(blade.frames[k].row(s), blade.frames[k].row(twin));
      EXPECT_EQ(blade.normals[k].row(s), blade.normals[k].row(twin));
    }
    EXPECT_NEAR(blade.uv(s, 0) - blade.uv(twin, 0), 0.1, 2.0 * kEps);
  }
  EXPECT_EQ(pairs, test::kRows + 1);
}

// Oracle: the colours themselves; what is above 1 is clipped.
TEST(Glb, ColoursComeBackAsGiven) {
  test::Sample sample;
  Clip clip = sample.clip();
  Points3 colours(sample.leaf.mesh.num_vertices(), 3);
  colours.rowwise() = Eigen::RowVector3d(0.5, 0.04, 1.7);
  clip.colours = {colours};
  clip.stalk_colours = {};
  const GlbFile file = parse_glb(glb_bytes(clip), "sample");
  ASSERT_EQ(file.meshes[0].colours.size(), 1U);
  EXPECT_NEAR(file.meshes[0].colours[0](3, 0), 0.5, 1e-7);
  EXPECT_NEAR(file.meshes[0].colours[0](3, 1), 0.04, 1e-7);
  EXPECT_EQ(file.meshes[0].colours[0](3, 2), 1.0);
  EXPECT_TRUE(file.meshes[1].colours.empty());
}

// Oracle: what was written, and the size of the arrays: of a morph target with 7 + 1 (on a seam) of 72 moving
// vertices 1 byte of index and 12 of value for each take less than 12 for all; the first frame takes one.
TEST(Glb, LeavesOutWhatDoesNotMove) {
  test::Sample sample;
  test::hold_most(sample);
  const Clip clip = sample.clip();
  const std::string bytes = glb_bytes(clip);
  const Json document = Json::parse(glb_json(bytes, ""));
  const auto accessor = [&](std::size_t target) -> const Json& {
    return document["accessors"]
                   [document["meshes"][0]["primitives"][0]["targets"][target]["POSITION"].get<std::size_t>()];
  };
  EXPECT_EQ(accessor(0)["sparse"]["count"], 1) << "a row of zeros: readers want data";
  const Json& sparse = accessor(2)["sparse"];
  EXPECT_EQ(sparse["count"], test::kColumns + 2);
  EXPECT_EQ(document["bufferViews"][sparse["values"]["bufferView"].get<std::size_t>()]["byteLength"],
            8 + 12 * (test::kColumns + 2));
  const GlbMesh blade = parse_glb(bytes, "calm").meshes[0];
  for (std::size_t k = 0; k < sample.frames.size(); ++k) {
    const Points3 expected = of_skin(sample.leaf, file_points({}, sample.frames[k].positions));
    EXPECT_LT((blade.frames[k] - expected).cwiseAbs().maxCoeff(), kEps * expected.cwiseAbs().maxCoeff());
  }
}

// Oracle: analytic. Three of the frames 0, 10, 30, 60, 100 in 4 s: times stay proportional to iterations.
TEST(Glb, FewerMorphsKeepTheirTimes) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip(), {.max_morphs = 3}), "sample");
  ASSERT_EQ(file.times.size(), 3U);
  EXPECT_EQ(file.iterations.front(), 0);
  EXPECT_EQ(file.iterations.back(), 100);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(file.times[k], 0.04 * file.iterations[k], 4.0 * kEps);
}

// Oracle: invariance.
TEST(Glb, TheSameSceneGivesTheSameBytes) {
  const test::Sample one, two;
  EXPECT_EQ(glb_bytes(one.clip()), glb_bytes(two.clip()));
}

// Oracle: the JSON that was given, its order and its 64-bit seed included.
TEST(Glb, KeepsTheConfigurationToTheLastDigit) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip()), "sample");
  const auto extras = nlohmann::ordered_json::parse(file.extras);
  EXPECT_EQ(extras["config"].dump(), R"({"seed":18446744073709551615,"iterations":100,"a":{"dt":0.01}})");
  EXPECT_EQ(extras["leaf"]["name"], sample.leaf.name);
  EXPECT_EQ(extras["leaf"]["seed"], sample.leaf.seed);
  EXPECT_EQ(extras["units"], "metres");
  EXPECT_EQ(extras["up"], "Y");
}

// Oracle: the blade's positions at the veins' faces; nine decimals of a position and of the weights.
TEST(Glb, VeinsLieOnTheBlade) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip()), "sample");
  ASSERT_EQ(file.veins.size(), 3U);
  EXPECT_EQ(file.veins[2].order, 2);
  for (const GlbVein& vein : file.veins) {
    for (int i = 0; i < vein.positions.rows(); ++i) {
      Vec3 point = Vec3::Zero();
      for (int c = 0; c < 3; ++c) {
        const int corner = file.meshes[0].faces(vein.faces[static_cast<std::size_t>(i)], c);
        point += vein.barycentric(i, c) * file.meshes[0].frames[0].row(corner).transpose();
      }
      EXPECT_LT((vein.positions.row(i).transpose() - point).norm(), 1e-8);
    }
  }
}

// Oracle: the leaf at rest; neither targets nor an animation.
TEST(Glb, OneFrameIsAMeshThatStandsStill) {
  Leaf leaf = test::sample_leaf();
  leaf.stalk = {};
  const std::vector<Frame> frames = rest_frames(leaf);
  const std::string bytes = glb_bytes({leaf, frames, nullptr, "{}", {}, {}, ""});
  const Json document = Json::parse(glb_json(bytes, ""));
  EXPECT_FALSE(document.contains("animations"));
  EXPECT_FALSE(document["meshes"][0]["primitives"][0].contains("targets"));
  const GlbFile file = parse_glb(bytes, "rest");
  ASSERT_EQ(file.meshes.size(), 1U);
  EXPECT_EQ(file.times, std::vector<double>{0.0});
  EXPECT_EQ(file.meshes[0].water.size(), 0);
  EXPECT_LT((file.meshes[0].frames[0] - of_skin(leaf, file_points({}, leaf.positions))).cwiseAbs().maxCoeff(),
            0.1 * kEps);
}

// Oracle: the bytes that were given stand in the file, named by their kind.
TEST(Glb, EmbedsATexture) {
  const test::Sample sample;
  Clip clip = sample.clip();
  clip.texture = "\xff\xd8\xff not quite a picture";
  const std::string bytes = glb_bytes(clip);
  EXPECT_NE(bytes.find(clip.texture), std::string::npos);
  EXPECT_EQ(Json::parse(glb_json(bytes, ""))["images"][0]["mimeType"], "image/jpeg");
}

TEST(Glb, IsWrittenToAFile) {
  const test::Sample sample;
  const std::string path =
      (std::filesystem::temp_directory_path() / ("wilt_glb_" + std::to_string(::getpid()))).string();
  write_glb(path, sample.clip());
  EXPECT_EQ(read_file(path), glb_bytes(sample.clip()));
  EXPECT_EQ(read_glb(path).iterations.back(), 100);
  std::filesystem::remove(path);
  EXPECT_THROW(write_glb(path + "/none/leaf.glb", sample.clip()), Error);
}

// Oracle: negative.
TEST(Glb, RefusesWrongOptionsAndScenes) {
  test::Sample sample;
  EXPECT_THROW(glb_bytes(sample.clip(), {.seconds = 0.0}), Error);
  EXPECT_THROW(glb_bytes(sample.clip(), {.stalk_sides = 2}), Error);
  EXPECT_THROW(glb_bytes(sample.clip(), {.max_morphs = 1}), Error);
  Clip short_colours = sample.clip();
  short_colours.colours.pop_back();
  EXPECT_THROW(glb_bytes(short_colours), std::logic_error);
  Clip broken_config = sample.clip();
  broken_config.config = "{";
  EXPECT_THROW(glb_bytes(broken_config), std::logic_error);
  sample.frames[2].positions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(glb_bytes(sample.clip()), std::logic_error);
}

// Oracle: negative; each kind of file that is none of ours.
TEST(Glb, RefusesWhatItDidNotWrite) {
  const test::Sample sample;
  const std::string bytes = glb_bytes(sample.clip());
  EXPECT_NE(refusal("").find("GLB header"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 0 an OBJ rather than a GLB").find("GLB header"), std::string::npos);
  EXPECT_NE(refusal(bytes.substr(0, bytes.size() / 2)).find("cut off"), std::string::npos);
  EXPECT_NE(refusal(join_glb("{]", "")).find("parse"), std::string::npos);
  EXPECT_NE(refusal(changed(bytes, [](Json& j) { j["asset"].erase("extras"); })).find("extras.wilt"),
            std::string::npos);
  const auto with_view = [&](const char* key, const Json& value) {
    return refusal(changed(bytes, [&](Json& j) { j["bufferViews"][0][key] = value; }));
  };
  EXPECT_NE(with_view("byteOffset", 1000000000).find("beyond"), std::string::npos);
  EXPECT_NE(with_view("buffer", 7).find("buffer 7"), std::string::npos);
  EXPECT_NE(refusal(changed(bytes, [](Json& j) { j["accessors"][0]["count"] = 1000000000; })).find("beyond"),
            std::string::npos);
  EXPECT_NE(refusal(changed(bytes,
                            [](Json& j) {
                              j["asset"]["extras"]["wilt"]["frames"] = {0, 1};
                            }))
                .find("2 iterations"),
            std::string::npos);
  EXPECT_NE(
      refusal(changed(bytes, [](Json& j) { j["asset"]["extras"]["wilt"]["veins"][0]["faces"][0] = 5000; }))
          .find("face 5000"),
      std::string::npos);
}

// Oracle: negative; what a reader of the frames would stumble over, and other files that it would open.
TEST(Glb, RefusesWhatCannotBeShown) {
  const test::Sample sample;
  const std::string bytes = glb_bytes(sample.clip());
  const auto says = [&](const char* part, const std::function<void(Json&)>& change) {
    const std::string message = refusal(changed(bytes, change));
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says("other files", [](Json& j) { j["buffers"][0]["uri"] = "/dev/zero"; });
  says("other files", [](Json& j) { j["images"][0]["uri"] = "leaf.png"; });
  says("nested deeper", [](Json& j) {
    Json deep = 1;
    for (int i = 0; i < 100; ++i) deep = Json::array({deep});
    j["asset"]["extras"]["wilt"]["config"] = deep;
  });
  says("outside 0 to 1", [](Json& j) { j["asset"]["extras"]["wilt"]["dryness"][1] = 2.0; });
  says("barycentric", [](Json& j) { j["asset"]["extras"]["wilt"]["veins"][0]["barycentric"][0][0] = 1e30; });
  says("morph targets have COLOR_0",
       [](Json& j) { j["meshes"][0]["primitives"][0]["targets"][1].erase("COLOR_0"); });
  says("is empty",
       [](Json& j) { j["accessors"][j["meshes"][0]["primitives"][0]["indices"].get<int>()]["count"] = 0; });
  says("beyond its end", [](Json& j) {
    Json& target = j["accessors"][j["meshes"][0]["primitives"][0]["targets"][0]["POSITION"].get<int>()];
    target["sparse"] = {{"count", 1},  // the first position, read as an index
                        {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                        {"values", {{"bufferView", 0}}}};
  });
  says("differs in size", [](Json& j) {
    j["accessors"][j["meshes"][0]["primitives"][0]["targets"][0]["POSITION"].get<int>()]["count"] =
        1000000000;
  });
  std::string unfinished = bytes;  // a value that is not a number
  const std::size_t data = 20 + glb_json(bytes, "").size() + 8;
  for (std::size_t i = 0; i < 4; ++i) unfinished[data + i] = '\xff';
  EXPECT_NE(refusal(unfinished).find("not finite"), std::string::npos);
}

// Oracle: property. Whatever byte is changed, the reader returns a file or an Error{input}; the seed is
// fixed.
TEST(Glb, ReaderBearsDamage) {
  const test::Sample sample;
  const std::string bytes = glb_bytes(sample.clip());
  const int json_size = static_cast<int>(glb_json(bytes, "").size());
  const std::uint64_t seed = 7;
  Random random(seed, "damage");
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string damaged = bytes;
    for (int i = 0; i < 2; ++i)
      damaged[static_cast<std::size_t>(20 + random.index(json_size))] =
          "0123456789{}[],:\"-a"[random.index(19)];
    try {
      const GlbFile file = parse_glb(damaged, "damaged");
      EXPECT_EQ(file.meshes.front().frames.size(), file.times.size())
          << "seed " << seed << " round " << round;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input) << "seed " << seed << " round " << round;
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);  // a tenth: most of the JSON is digits of veins, which may change
}

}  // namespace
}  // namespace wilt
