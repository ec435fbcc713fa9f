#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "output/sample_leaf.hpp"
#include "wilt/core/error.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

Vec3 vector_of(const Json& list) {
  return Vec3(list.at(0), list.at(1), list.at(2));
}

// Oracle: the product's contract, key by key.
TEST(VeinsJson, HasTheKeysThatScriptsRelyOn) {
  const Leaf leaf = test::sample_leaf();
  const Json json = Json::parse(veins_json(leaf, test::sample_venation(leaf)));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"leaf", "petiole", "margin", "tips", "veins"}));
  EXPECT_EQ(keys(json["leaf"]),
            (std::vector<std::string>{"vertices", "faces", "length", "boundary_vertices"}));
  EXPECT_EQ(keys(json["petiole"]), (std::vector<std::string>{"vertex", "position", "uv"}));
  EXPECT_EQ(keys(json["margin"]), (std::vector<std::string>{"s", "d"}));
  EXPECT_EQ(keys(json["tips"][0]),
            (std::vector<std::string>{"vertex", "position", "uv", "s", "d", "prominence"}));
  EXPECT_EQ(keys(json["veins"][0]), (std::vector<std::string>{"order", "tip", "length", "positions", "uv"}));
  EXPECT_EQ(keys(json["veins"][2]), (std::vector<std::string>{"order", "length", "positions", "uv"}));
}

// Oracle: the leaf and its veins, to the last digit (JSON numbers are written to round-trip).
TEST(VeinsJson, HoldsPositionsAndTextureCoordinates) {
  Leaf leaf = test::sample_leaf();
  leaf.placement = test::sample_placement();
  const Venation venation = test::sample_venation(leaf);
  const Json json = Json::parse(veins_json(leaf, venation));
  const Points3 expected = file_points(leaf.placement, leaf.positions);
  EXPECT_EQ(json["petiole"]["vertex"], int(leaf.petiole));
  EXPECT_EQ(vector_of(json["petiole"]["position"]), Vec3(expected.row(leaf.petiole)));
  const Vec2 tip_uv = leaf.skin.uv.row(venation.tips[1].vertex);
  EXPECT_EQ(json["tips"][1]["uv"].get<std::vector<double>>(), (std::vector<double>{tip_uv[0], tip_uv[1]}));
  const SurfacePoint& middle = venation.veins[0].path.points[1];
  Vec3 position = Vec3::Zero();
  Vec2 uv = Vec2::Zero();
  for (int c = 0; c < 3; ++c) {
    position +=
        middle.barycentric[c] * expected.row(leaf.mesh.face_matrix()(int(middle.face), c)).transpose();
    uv += middle.barycentric[c] * leaf.skin.uv.row(leaf.skin.faces(int(middle.face), c)).transpose();
  }
  EXPECT_LT((vector_of(json["veins"][0]["positions"][1]) - position).norm(), 1e-13);
  EXPECT_NEAR(json["veins"][0]["uv"][1][0].get<double>(), uv[0], 1e-15);
  EXPECT_NEAR(json["veins"][0]["uv"][1][1].get<double>(), uv[1], 1e-15);
  EXPECT_EQ(json["veins"][0]["length"], 0.11);
  EXPECT_EQ(json["margin"]["s"].size(), venation.margin.vertices.size());
}

// Oracle: analytic; pixel = origin + uv * size.
TEST(VeinsJson, GivesPixelsInAPhoto) {
  Leaf leaf = test::sample_leaf();
  leaf.photo = std::make_shared<LeafPhoto>(LeafPhoto{{}, {Vec2(10, 20), Vec2(640, 480)}});
  const Json json = Json::parse(veins_json(leaf, test::sample_venation(leaf)));
  EXPECT_EQ(keys(json["petiole"]), (std::vector<std::string>{"vertex", "position", "uv", "pixel"}));
  const Json& tip = json["tips"][0];
  EXPECT_NEAR(tip["pixel"][0].get<double>(), 10.0 + 640.0 * tip["uv"][0].get<double>(), 1e-12);
  EXPECT_NEAR(tip["pixel"][1].get<double>(), 20.0 + 480.0 * tip["uv"][1].get<double>(), 1e-12);
}

// Oracle: the text itself. What was written is read as the veins that were found, and drawn again as they
// are.
TEST(VeinsJson, ReadsWhatItWrote) {
  Leaf leaf = test::sample_leaf();
  leaf.placement = test::sample_placement();
  const Venation venation = test::sample_venation(leaf);
  const std::string text = veins_json(leaf, venation);
  const std::vector<DrawnVein> drawn = parse_veins_json(text, "veins.json", leaf, venation);
  ASSERT_EQ(drawn.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(drawn[std::size_t(i)].found, i);
  EXPECT_EQ(veins_json(leaf, with_drawn_veins(leaf, venation, drawn)), text);
}

// Oracle: places on the surface that are known: each way to give a point leads to the same one.
TEST(VeinsJson, ReadsPointsInEveryWay) {
  Leaf leaf = test::sample_leaf();
  leaf.placement = test::sample_placement();
  leaf.photo = std::make_shared<LeafPhoto>(LeafPhoto{{}, {Vec2(10, 20), Vec2(640, 480)}});
  const Venation venation = test::sample_venation(leaf);
  const SurfacePoint place{FaceId(leaf.mesh.num_faces() / 2), Vec3(0.2, 0.3, 0.5)};
  const Vec3 expected = position(leaf.mesh, leaf.positions, place);
  Vec2 uv = Vec2::Zero();
  for (int c = 0; c < 3; ++c)
    uv += place.barycentric[c] * leaf.skin.uv.row(leaf.skin.faces(int(place.face), c)).transpose();
  const Points3 in_file = file_points(leaf.placement, expected.transpose());
  const Json ways[] = {{{"positions", {{in_file(0, 0), in_file(0, 1), in_file(0, 2)}}}},
                       {{"uv", {{uv[0], uv[1]}}}},
                       {{"pixel", {{10 + 640 * uv[0], 20 + 480 * uv[1]}}}}};
  for (const Json& way : ways) {
    Json vein = way;
    vein["order"] = 2;
    const Json document = {{"veins", Json::array({vein})}};
    const std::vector<DrawnVein> drawn = parse_veins_json(document.dump(), "v", leaf, venation);
    ASSERT_EQ(drawn.size(), 1u);
    EXPECT_EQ(drawn[0].found, -1);
    ASSERT_EQ(drawn[0].points.size(), 1u);
    EXPECT_LT((position(leaf.mesh, leaf.positions, drawn[0].points[0]) - expected).norm(), 1e-9) << document;
  }
}

// Negative: each is refused with its place and the way out.
TEST(VeinsJson, RefusesWhatCannotBeMeant) {
  const Leaf leaf = test::sample_leaf();
  const Venation venation = test::sample_venation(leaf);
  const Json good = Json::parse(veins_json(leaf, venation));
  const auto says = [&](const std::string& text, const char* what) {
    try {
      parse_veins_json(text, "v.json", leaf, venation);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const auto edited = [&](auto edit) {
    Json document = good;
    edit(document);
    return document.dump();
  };
  says("{", "not JSON");
  says("[]", "no list \"veins\"");
  says(edited([](Json& d) { d["leaf"]["vertices"] = 7; }), "another leaf's veins: its vertices is 7");
  says(edited([](Json& d) { d["veins"][1]["positins"] = 1; }), "did you mean 'positions'?");
  says(edited([](Json& d) { d["veins"][1].erase("order"); }), "veins[1]: \"order\" must be 1");
  says(edited([](Json& d) { d["veins"][1]["uv"].erase(0); }), "not the same places");
  says(edited([](Json& d) { d["veins"][1]["uv"] = {{1, 2, 3}}; }), "points of 2 numbers");
  says(edited([](Json& d) { d["veins"][0] = {{"order", 1}, {"uv", {{3.0, 0.5}}}}; }), "beside the blade");
  says(edited([](Json& d) { d["veins"][0] = {{"order", 1}, {"pixel", {{3.0, 0.5}}}}; }), "needs a photo");
  says(edited([](Json& d) { d["veins"][0] = {{"order", 1}}; }), "neither");
}

// Oracle: an XML parser that is not ours, and the sample's counts.
TEST(VeinsSvg, IsWellFormedAndHoldsEveryVeinAndTip) {
  const Leaf leaf = test::sample_leaf();
  const std::string text = veins_svg(leaf, test::sample_venation(leaf));
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_string(text.c_str());
  ASSERT_TRUE(parsed) << parsed.description();
  const pugi::xml_node svg = document.child("svg");
  EXPECT_EQ(svg.child("title").text().as_string(), leaf.name + ": 2 tips");
  EXPECT_EQ(svg.select_nodes("g[@class='veins order-1']/path").size(), 2U);
  EXPECT_EQ(svg.select_nodes("g[@class='veins order-2']/path").size(), 1U);
  EXPECT_EQ(svg.select_nodes("g[@class='tips']/circle").size(), 2U);
  EXPECT_STREQ(svg.select_nodes("g[@class='tips']/text")[1].node().text().as_string(), "2");
  EXPECT_EQ(svg.select_nodes("path[@class='stalk']").size(), 1U);
}

// Oracle: the sample's 60 mm x 100 mm above a stalk of 40 mm, and a margin of 6 % of the blade's diagonal all
// around.
TEST(VeinsSvg, IsInMillimetresSeenFromAbove) {
  const Leaf leaf = test::sample_leaf();
  pugi::xml_document document;
  document.load_string(veins_svg(leaf, test::sample_venation(leaf)).c_str());
  const pugi::xml_node svg = document.child("svg");
  const double margin = 0.06 * std::hypot(60.0, 100.0);
  std::istringstream box(svg.attribute("viewBox").as_string());
  double x = 0, y = 0, width = 0, height = 0;
  box >> x >> y >> width >> height;
  EXPECT_NEAR(x, -30.0 - margin, 1e-3);  // three decimals
  EXPECT_NEAR(y, -100.0 - margin, 1e-3);
  EXPECT_NEAR(width, 60.0 + 2.0 * margin, 1e-3);
  EXPECT_NEAR(height, 140.0 + 2.0 * margin, 1e-3);
  EXPECT_NEAR(svg.attribute("width").as_double(), width, 1e-3);
  // The first tip is the upper left corner of the blade.
  const pugi::xml_node dot = svg.select_node("g[@class='tips']/circle").node();
  EXPECT_NEAR(dot.attribute("cx").as_double(), -30.0, 1e-3);
  EXPECT_NEAR(dot.attribute("cy").as_double(), -100.0, 1e-3);
}

}  // namespace
}  // namespace wilt
