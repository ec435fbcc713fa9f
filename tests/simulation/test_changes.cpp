// Settings that change in a run, and the forces and dry regions that are given as lists.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "simulation/case.hpp"
#include "wilt/core/error.hpp"
#include "wilt/simulation/external_force.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

Case make_subject(const std::string& model) {
  Case c = make_case("maple", model, 300);
  c.config.iterations = 12;
  c.config.frames = 4;
  return c;
}

Simulation start(const Case& s) {
  return {s.leaf, s.venation, s.config};
}

void steps(Simulation& simulation, int count) {
  for (int k = 0; k < count; ++k) simulation.step();
}

// All numbers of a run; not its configuration.
StateArrays numbers_of(const Simulation& simulation) {
  return simulation.checkpoint().arrays;
}

std::string bytes_of(const Simulation& simulation) {
  return checkpoint_bytes(simulation.checkpoint());
}

double water_of(const Simulation& simulation) {
  return simulation.model().water().sum();
}

class ChangedRun : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Models, ChangedRun, testing::ValuesIn(model_names()));

// Oracle: the run in which nothing was touched, bit by bit.
TEST_P(ChangedRun, IsTheSameRunWhenASettingGetsTheValueThatItHas) {
  for (const char* pin : {"ring", "free"}) {
    Case s = make_subject(GetParam());
    s.config.pin = pin;
    Simulation plain = start(s), touched = start(s);
    steps(plain, 12);
    for (int k = 0; k < 12; ++k) {
      touched.change("springs.stiffness", "4");
      touched.step();
    }
    EXPECT_EQ(touched.config().changes.size(), 12u);
    EXPECT_TRUE(numbers_of(touched) == numbers_of(plain)) << pin;
  }
}

// Oracle: two ways to say the same; every setting that may change is changed in one of them.
TEST_P(ChangedRun, IsTheRunOfItsOwnConfiguration) {
  const Case s = make_subject(GetParam());
  Simulation live = start(s);
  steps(live, 3);
  live.change("water.loss_rate", "0.05");
  live.change("external.growth", "3");
  live.change("external.growth", "2");  // the later wins
  steps(live, 4);
  live.change("springs.stiffness", "6");
  live.change("bending.stiffness", "0.002");
  live.change("gravity.strength", "0.008");
  live.change("water.dry_region", "0,0,0.5,0,0.5,0.5,0,0.5");
  live.change("solver.tolerance", "1e-7");
  steps(live, 5);
  Case told = s;
  apply_toml(told.config, to_toml(live.config(), false), "run.toml");
  EXPECT_EQ(to_json(told.config), to_json(live.config()));
  Simulation again = start(told);
  steps(again, 12);
  EXPECT_TRUE(bytes_of(again) == bytes_of(live));
  Simulation plain = start(s);
  steps(plain, 12);
  EXPECT_FALSE(numbers_of(plain) == numbers_of(live));
}

// Oracle: the run that was never left, wherever the other one was left: before, at and after the changes; and
// taken back to where it had been before them.
TEST_P(ChangedRun, GoesOnFromACheckpointAsIfItHadNeverBeenLeft) {
  Case s = make_subject(GetParam());
  add_change(s.config, 0, "water.loss_rate", "0.04");
  add_change(s.config, 4, "springs.stiffness", "7");
  add_change(s.config, 4, "water.diffusion", "0.3");
  add_change(s.config, 6, "water.diffusion", "0.05");
  add_change(s.config, 6, "water.dry_region", "0,0,0.5,0,0.5,0.5");
  add_change(s.config, 6, "pressure.cell_constant", "3e-4");
  add_change(s.config, 8, "gravity.strength", "0.01");
  add_change(s.config, 8, "springs.stiffness", "3");
  Simulation whole = start(s);
  std::vector<Checkpoint> left{whole.checkpoint()};
  for (; !whole.ended(); left.push_back(whole.checkpoint())) whole.step();
  Simulation other = start(s);
  for (std::size_t k = left.size(); k-- > 0;) {
    other.restore(left[k]);
    EXPECT_TRUE(bytes_of(other) == checkpoint_bytes(left[k])) << k;
    if (k + 1 == left.size()) continue;
    other.step();
    ASSERT_TRUE(bytes_of(other) == checkpoint_bytes(left[k + 1])) << "left after " << k;
  }
}

// Oracle: the configuration that has the values from the start; what is remembered of the first state (water
// that the leaf began with, rest lengths) depends on no setting that may change.
TEST_P(ChangedRun, AfterIterationNoughtIsTheRunWithThoseSettings) {
  Case changed = make_subject(GetParam()), plain = make_subject(GetParam());
  for (const auto& [key, value] : std::map<std::string, std::string>{{"water.loss_rate", "0.04"},
                                                                     {"swelling.coefficient", "1.5"},
                                                                     {"external.range", "0.5"},
                                                                     {"water.dry_region", "-1,0,1,0,0,1"}}) {
    add_change(changed.config, 0, key, value);
    set(plain.config, key, value);
  }
  Simulation a = start(changed), b = start(plain);
  steps(a, 12);
  steps(b, 12);
  StateArrays at_rest_too = numbers_of(a), from_the_start = numbers_of(b);
  at_rest_too.erase("forces");  // at rest they are still those of the other settings
  from_the_start.erase("forces");
  EXPECT_TRUE(at_rest_too == from_the_start);
}

// Oracle: air that is saturated takes nothing, and the loss goes as 1 - humidity; no cell is dry yet.
TEST(Change, OfTheHumiditySetsWhatTheAirTakes) {
  const Case s = make_subject("cell");
  Simulation simulation = start(s);
  const auto lost = [&](const char* humidity) {
    simulation.change("water.humidity", humidity);
    const double before = water_of(simulation);
    steps(simulation, 2);
    return before - water_of(simulation);
  };
  const double round_off = 1e-12 * water_of(simulation);
  const double usual = lost("0.5");
  EXPECT_GT(usual, 1e6 * round_off);
  EXPECT_NEAR(lost("1"), 0.0, round_off);
  EXPECT_NEAR(lost("0.2"), usual * (1 - 0.2) / (1 - 0.5), round_off);
  EXPECT_NEAR(lost("0.75"), usual / 2, round_off);
}

std::string refusal(Simulation& simulation, const char* key, const char* value) {
  try {
    simulation.change(key, value);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    return error.what();
  }
  return "no error";
}

TEST(Change, IsRefusedWhereItMeansNothingAndChangesNothingThen) {
  const Case s = make_subject("cell");
  Simulation simulation = start(s), plain = start(s);
  for (const char* key : {"dt", "iterations", "frames", "model", "pin", "vertices", "seed", "mass.max",
                          "veins.secondary", "water.dryness_scale", "external.variant", "external.forces",
                          "reference.vertices", "texture.size", "clip.seconds"})
    EXPECT_NE(refusal(simulation, key, "1").find("cannot change in a run"), std::string::npos) << key;
  EXPECT_NE(refusal(simulation, "water.humidty", "1").find("did you mean"), std::string::npos);
  EXPECT_NE(refusal(simulation, "water.humidity", "2").find("between 0 and 1"), std::string::npos);
  steps(simulation, 1);
  steps(plain, 1);
  EXPECT_TRUE(bytes_of(simulation) == bytes_of(plain));
}

TEST(Change, ThatComesTooLateIsSaid) {
  Case s = make_subject("cell");
  add_change(s.config, 11, "water.humidity", "0.1");
  EXPECT_EQ(start(s).result().note, "");
  add_change(s.config, 12, "water.humidity", "0.2");
  EXPECT_NE(start(s).result().note.find("after iteration 12 never comes"), std::string::npos);
}

// Oracle: the sum over the cells by hand; a strip's cells are told by their coordinate alone. The pentagram's
// middle lies outside by the even-odd rule.
TEST_P(ChangedRun, LosesMoreWithinADryRegion) {
  Case s = make_subject(GetParam());
  const Eigen::MatrixXd places = s.leaf.positions / leaf_length(s.leaf);
  const auto lost = [&](const char* region, const char* factor) {
    Case dry = s;
    set(dry.config, "water.diffusion", "0");
    set(dry.config, "water.dry_region", region);
    set(dry.config, "water.dry_factor", factor);
    Simulation simulation = start(dry);
    const Eigen::VectorXd before = simulation.model().water();
    simulation.step();
    return Eigen::VectorXd(before - simulation.model().water());
  };
  const Eigen::VectorXd even = lost("", "3"), strip = lost("-9,0.5,9,0.5,9,0.75,-9,0.75", "4");
  int within = 0;
  for (int v = 0; v < even.size(); ++v) {
    const bool inside = places(v, 1) > 0.5 && places(v, 1) < 0.75;
    within += inside ? 1 : 0;
    EXPECT_NEAR(strip[v], (inside ? 4.0 : 1.0) * even[v], 1e-13) << v;
  }
  EXPECT_GT(within, 20);
  EXPECT_NEAR(strip.sum(), even[0] * (4.0 * within + (even.size() - within)), 1e-11);
  const Eigen::VectorXd none = lost("-9,0.5,9,0.5,9,0.75,-9,0.75", "0");
  EXPECT_NEAR(none.sum(), even[0] * (even.size() - within), 1e-11);
  const Eigen::VectorXd twice = lost("-9,-9,9,-9,9,9,-9,9,-9,-9,9,-9,9,9,-9,9", "5");  // around it two times
  EXPECT_NEAR((twice - even).cwiseAbs().maxCoeff(), 0.0, 1e-13);
}

// Oracle: Table 2 of the paper, given as numbers.
TEST_P(ChangedRun, TakesTheForcesThatAreGiven) {
  Case s = make_subject(GetParam());
  ASSERT_EQ(s.venation.tips.size(), 7u);
  s.config.external.variant = "d";
  Case given = s;
  given.config.external.variant = "a";
  const Points3 d = initial_tip_forces(7, "d");
  for (int r = 0; r < 7; ++r) {
    for (int k = 0; k < 3; ++k) given.config.external.forces.push_back(d(r, k));
  }
  Simulation by_name = start(s), by_number = start(given);
  steps(by_name, 5);
  steps(by_number, 5);
  EXPECT_TRUE(numbers_of(by_name) == numbers_of(by_number));
  given.config.external.forces.resize(18);
  try {
    start(given);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    EXPECT_NE(std::string(error.what()).find("18 numbers, but the leaf has 7 tips"), std::string::npos);
  }
}

}  // namespace
}  // namespace wilt
