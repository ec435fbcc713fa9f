// A run that was left and gone on with, against one that was not.
#include <gtest/gtest.h>

#include "simulation/case.hpp"
#include "wilt/core/error.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

Case make_subject(const std::string& name, const std::string& model) {
  Case c = make_case(name, model, 300);
  c.config.iterations = 12;
  c.config.frames = 5;
  return c;
}

Simulation start(const Case& s) {
  return {s.leaf, s.venation, s.config};
}

// The state of a run as bytes: all that there is of it.
std::string bytes_of(const Simulation& simulation) {
  return checkpoint_bytes(simulation.checkpoint());
}

Simulation resume(const Case& s, const std::string& bytes) {
  Simulation simulation = start(s);
  simulation.restore(parse_checkpoint(bytes, "run.checkpoint"));
  return simulation;
}

class ResumedRun : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Checkpoints, ResumedRun, testing::ValuesIn(model_names()));

// Oracle: the run that was never left, bit by bit, wherever the other one was left: motion, water, petiole,
// frames, metrics, steps and forces are all in the bytes.
TEST_P(ResumedRun, GoesOnAsIfItHadNeverBeenLeft) {
  for (const char* pin : {"ring", "free"}) {
    Case s = make_subject("ivy", GetParam());
    s.config.pin = pin;
    Simulation whole = start(s);
    std::vector<std::string> states{bytes_of(whole)};
    for (; !whole.ended(); states.push_back(bytes_of(whole))) whole.step();
    for (std::size_t left = 0; left + 1 < states.size(); ++left) {
      Simulation other = resume(s, states[left]);
      EXPECT_EQ(bytes_of(other), states[left]);
      other.step();
      ASSERT_EQ(bytes_of(other), states[left + 1]) << pin << ", left after " << left;
    }
    const std::string hash = std::move(whole).finish().positions_hash;
    const SimulationResult resumed = simulate(resume(s, states[5]));
    EXPECT_TRUE(resumed.completed);
    EXPECT_EQ(resumed.positions_hash, hash);
    EXPECT_EQ(resumed.frames.size(), 5u);
  }
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "no error";
}

// Oracle: planted differences, each named.
TEST(Checkpoint, IsRefusedForAnotherRun) {
  const Case s = make_subject("tilia", "cell");
  Simulation simulation = start(s);
  simulation.step();
  const std::string bytes = bytes_of(simulation);
  const auto refusal = [&](const Case& other) { return message_of([&] { resume(other, bytes); }); };
  Case drier = s;
  drier.config.water.humidity = 0.25;
  EXPECT_NE(refusal(drier).find("water.humidity was 0.5 and is 0.25"), std::string::npos) << refusal(drier);
  Case moved = s;
  moved.leaf.positions(17, 2) += 1e-9;
  EXPECT_NE(refusal(moved).find("another leaf"), std::string::npos);
  Case other_veins = s;
  other_veins.venation.veins.back().path.points.back().barycentric = Vec3(0.5, 0.5, 0.0);
  EXPECT_NE(refusal(other_veins).find("other veins"), std::string::npos);
}

// Oracle: every byte counts; the hash is not the reader's own guard, so some changes carry a new one.
TEST(Checkpoint, IsRefusedWhenCutOffOrChanged) {
  const Case s = make_subject("tilia", "paper");
  const std::string bytes = bytes_of(start(s));
  const auto refusal = [](const std::string& changed) {
    return message_of([&] { parse_checkpoint(changed, "x"); });
  };
  EXPECT_NE(refusal("").find("is not a checkpoint"), std::string::npos);
  EXPECT_NE(refusal("wilt checkpoint 2\n").find("is not a checkpoint"), std::string::npos);
  for (const std::size_t size : {std::size_t{18}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_NE(refusal(bytes.substr(0, size)), "no error") << size;
  for (std::size_t at = 0; at < bytes.size(); at += 997) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    EXPECT_NE(refusal(changed), "no error") << at;
  }
}

// Oracle: arrays of the wrong size or kind, planted in the structure.
TEST(Checkpoint, IsRefusedWhenItsArraysDoNotFit) {
  const Case s = make_subject("tilia", "cell");
  Simulation simulation = start(s);
  simulation.step();
  const Checkpoint good = simulation.checkpoint();
  const auto refusal = [&](const std::function<void(Checkpoint&)>& change) {
    Checkpoint bad = good;
    change(bad);
    return message_of([&] { start(s).restore(bad); });
  };
  EXPECT_EQ(refusal([](Checkpoint&) {}), "no error");
  EXPECT_NE(refusal([](Checkpoint& c) { c.arrays.erase("water.water"); }).find("'water.water' is missing"),
            std::string::npos);
  EXPECT_NE(refusal([](Checkpoint& c) { c.arrays["motion.jerks"].conservativeResize(7, 3); }).find("7 x 3"),
            std::string::npos);
  EXPECT_NE(refusal([](Checkpoint& c) { c.arrays["forces"](0, 1) = 9.0; }).find("region"), std::string::npos);
  EXPECT_NE(refusal([](Checkpoint& c) { c.arrays["steps"](0, 2) = -1.0; }).find("count"), std::string::npos);
  EXPECT_NE(refusal([](Checkpoint& c) { c.iteration = 11; }).find("1 steps"), std::string::npos);
}

}  // namespace
}  // namespace wilt
