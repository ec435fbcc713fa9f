// The session behind the studio's page. Oracles: a plain Simulation of the configuration that it writes, runs
// that were never left, the veins before they were edited.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/studio/live_frame.hpp"
#include "wilt/studio/session.hpp"
#include "wilt/studio/settings_json.hpp"

namespace wilt {
namespace {

const std::string kShort = "iterations = 12\nframes = 3\ntexture.size = 0\n";

StudioSession maple(const std::string& toml = kShort, const VeinEdits& edits = {}) {
  return {make_leaf("maple", 400, 1), edits, "maple", {{"vertices", "400"}, {"seed", "1"}}, toml};
}

void step_to(StudioSession& session, int iteration) {
  while (session.simulation().iteration() < iteration) session.step();
}

// What `wilt simulate --config` makes of the file that a session writes.
Points3 by_its_own_toml(const StudioSession& session) {
  Config config = resolve_config("maple", session.file("toml"), "run.toml", {});
  config.iterations = session.simulation().iteration();
  return simulate(session.leaf(), session.venation(), config).frames.back().positions;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(StudioSession, IsTheRunOfTheConfigurationThatItWrites) {
  for (const std::string model : {"cell", "paper"}) {
    StudioSession session = maple(kShort + "model = \"" + model + "\"\nwater.humidity = 0.2\n");
    step_to(session, 4);
    session.change("water.temperature_c", "35");
    step_to(session, 9);
    session.change("swelling.coefficient", "2");
    step_to(session, 12);
    EXPECT_EQ(session.simulation().frame().positions, by_its_own_toml(session)) << model;
  }
}

TEST(StudioSession, RewindsToWhatWasThere) {
  StudioSession session = maple();
  step_to(session, 3);
  session.change("water.humidity", "0.1");
  step_to(session, 7);
  const Points3 seventh = session.simulation().frame().positions;
  const std::string settings = session.file("toml");
  step_to(session, 9);
  session.change("water.humidity", "0.9");
  step_to(session, 12);
  session.rewind(7);
  EXPECT_EQ(session.simulation().iteration(), 7);
  EXPECT_EQ(session.simulation().frame().positions, seventh);
  EXPECT_EQ(session.file("toml"), settings) << "the change after iteration 9 is forgotten";
  EXPECT_NE(refusal([&] { session.rewind(8); }).find("from 0 to 7"), std::string::npos);
}

TEST(StudioSession, StaysAsItWasWhenSomethingIsRefused) {
  StudioSession session = maple();
  step_to(session, 5);
  const Points3 before = session.simulation().frame().positions;
  EXPECT_NE(refusal([&] { session.start("water.humidty = 1\n"); }).find("water.humidity"), std::string::npos);
  EXPECT_NE(refusal([&] { session.change("water.humidity", "2"); }).find("between"), std::string::npos);
  EXPECT_NE(refusal([&] { session.change("seed", "2"); }), "nothing was refused");
  EXPECT_NE(refusal([&] { (void)session.file("glb2"); }).find("forces.csv"), std::string::npos);
  EXPECT_EQ(session.simulation().frame().positions, before);
  EXPECT_EQ(session.simulation().iteration(), 5);
}

TEST(StudioSession, UnusualTomlGivesTheConfigurationBack) {
  StudioSession session = maple(kShort + "water.humidity = 0.25\nexternal.variant = \"c\"\n");
  step_to(session, 2);
  session.change("curvature.roll", "20");
  const std::string unusual = unusual_toml(session.config());
  EXPECT_EQ(to_json(resolve_config("maple", unusual, "unusual", {})), to_json(session.config()));
  EXPECT_LT(unusual.size(), 300u) << unusual;
}

TEST(StudioSession, ListsEverySettingWithItsValueNow) {
  StudioSession session = maple();
  step_to(session, 2);
  session.change("water.humidity", "0.75");
  const auto list = nlohmann::json::parse(settings_json(session.settings_now()));
  ASSERT_EQ(list.size(), settings().size());
  for (const auto& row : list) {
    if (row["key"] != "water.humidity") continue;
    EXPECT_EQ(row["value"], 0.75);
    EXPECT_EQ(row["usual"], 0.5);
    EXPECT_EQ(row["kind"], "number");
    EXPECT_EQ(row["duringRun"], true);
  }
}

TEST(EditedVenation, TakesATipAwayAndPutsItBack) {
  const Leaf leaf = make_leaf("maple", 400, 1);
  const VenationOptions options;
  const Venation found = find_venation(leaf, species("maple").secondary, options);
  ASSERT_EQ(found.tips.size(), 7u);
  const double s = found.tips[2].s;
  const Venation fewer = edited_venation(leaf, found, {{}, {s}}, options);
  ASSERT_EQ(fewer.tips.size(), 6u);
  for (const Tip& tip : fewer.tips) EXPECT_NE(tip.vertex, found.tips[2].vertex);
  const Venation again = edited_venation(leaf, found, {{s}, {s}}, options);
  ASSERT_EQ(again.tips.size(), 7u);
  EXPECT_EQ(again.tips[2].vertex, found.tips[2].vertex);
  EXPECT_NEAR(again.veins[2].path.length, found.veins[2].path.length, 1e-3 * leaf_length(leaf));
  std::vector<double> all;
  for (const Tip& tip : found.tips) all.push_back(tip.s);
  EXPECT_NE(refusal([&] { edited_venation(leaf, found, {{}, all}, options); }), "nothing was refused");
  EXPECT_NE(refusal([&] {
              edited_venation(leaf, found, {{-1.0}, {}}, options);
            }).find("margin"),
            std::string::npos);
}

TEST(LiveFrame, ShowsTheStateOfTheRun) {
  StudioSession session = maple();
  EXPECT_EQ(live_frame(session).water_left, 1.0);
  step_to(session, 12);
  const LiveLeaf leaf = live_leaf(session);
  const LiveFrame frame = live_frame(session);
  const Frame now = session.simulation().frame();
  const DeformationModel& model = session.simulation().model();
  EXPECT_EQ(frame.water_left, model.water().sum() / session.first_water());
  EXPECT_LT(frame.water_left, 1.0);
  ASSERT_EQ(leaf.vertex.size(), session.leaf().skin.vertex.size());
  ASSERT_EQ(frame.positions.size(), 3 * leaf.vertex.size());
  const auto& [mass, water, fraction, dryness, pressure, elastic, damping, swelling, external] = frame.fields;
  for (std::size_t p = 0; p < leaf.vertex.size(); ++p) {
    const auto v = static_cast<Eigen::Index>(leaf.vertex[p]);
    // Y up: (x, y, z) becomes (x, z, -y).
    EXPECT_EQ(frame.positions[3 * p], static_cast<float>(now.positions(v, 0)));
    EXPECT_EQ(frame.positions[3 * p + 1], static_cast<float>(now.positions(v, 2)));
    EXPECT_EQ(frame.positions[3 * p + 2], static_cast<float>(-now.positions(v, 1)));
    EXPECT_FLOAT_EQ(water[p] / mass[p], fraction[p]);
    EXPECT_EQ(pressure[p], static_cast<float>(-model.pressure_drop()[v]));
  }
  EXPECT_EQ(frame.stalk_positions.size(), 3u * leaf.stalk_points);
  EXPECT_EQ(frame.veins.size(), 3u * leaf.vein_start.back());
  EXPECT_EQ(leaf.vein_order.size() + 1, leaf.vein_start.size());
  // A primary vein ends at its tip, which moves with the blade.
  const std::size_t end = leaf.vein_start[1] - 1, tip = leaf.tip_points[0];
  for (std::size_t c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(frame.veins[3 * end + c], frame.positions[3 * tip + c]);
}

TEST(LiveFrame, SaysTheForcesAtTipsInTheUnitOfTable2) {
  // fout = fout_0 (1 + growth t): docs/method.md; the first force of every tip of "a" points up the most.
  for (const std::string model : {"cell", "paper"}) {
    StudioSession session = maple(kShort + "external.growth = 0.5\nexternal.forces = [" +
                                  std::string("0,0,0.1, 0,0.1,0, 0.1,0,0, 0,0,0, 0,0,0, 0,0,0, 0,0,-0.2") +
                                  "]\nmodel = \"" + model + "\"\n");
    step_to(session, 2);
    const LiveFrame frame = live_frame(session);
    const double grown = 1.0 + 0.5 * 2 * session.config().dt;
    const std::vector<float>& f = frame.tip_forces;
    EXPECT_NEAR(f[1], 0.1 * grown, 1e-6) << model;   // z up is Y
    EXPECT_NEAR(f[5], -0.1 * grown, 1e-6) << model;  // y is -Z
    EXPECT_NEAR(f[6], 0.1 * grown, 1e-6) << model;
    EXPECT_NEAR(f[19], -0.2 * grown, 1e-6) << model;
  }
}

}  // namespace
}  // namespace wilt
