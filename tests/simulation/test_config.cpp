#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt {
namespace {

std::string message_of(const std::string& key, const std::string& value) {
  Config config;
  try {
    set(config, key, value);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Oracle: the text itself, out and in again.
TEST(Config, ComesBackFromItsOwnToml) {
  Config config = default_config(species("tilia"));
  set(config, "water.humidity", "0.123456789012345678");
  set(config, "veins.secondary", "false");
  set(config, "pin", "free");
  set(config, "seed", "8999999999999999");
  set(config, "water.dry_region", "0.1,-0.25,1e-3,0.5,3,1");
  set(config, "external.forces", "");
  add_change(config, 40, "water.humidity", "0.2");
  add_change(config, 7, "water.dry_region", "");
  add_change(config, 40, "solver.max_newton", "12");
  add_change(config, 7, "water.dry_region", "0,0,1,0,0,1");
  for (const bool commented : {false, true}) {
    Config back;
    apply_toml(back, to_toml(config, commented), "test");
    EXPECT_EQ(to_toml(back, false), to_toml(config, false));
    EXPECT_EQ(to_json(back), to_json(config));
  }
}

TEST(Config, JsonHoldsEverySetting) {
  const auto json = nlohmann::json::parse(to_json(Config()));
  EXPECT_EQ(json.size(), settings().size());
  EXPECT_EQ(json.at("springs.stiffness"), 4.0);
}

// Oracle: Table 1 of the paper.
TEST(Config, TakesTableOneFromTheSpecies) {
  const Config willow = default_config(species("willow"));
  EXPECT_EQ(willow.mass.min, 0.75);
  EXPECT_EQ(willow.mass.max, 1.55);
  EXPECT_EQ(willow.water.loss_rate, 0.025);
  EXPECT_EQ(willow.external.range, 0.8);
  const Config ivy = default_config(species("ivy"));
  EXPECT_EQ(ivy.mass.min, 0.80);
  EXPECT_EQ(ivy.mass.max, 1.00);
}

TEST(Config, EveryDefaultLiesInItsRange) {
  Config config;
  for (const Setting& setting : settings()) {
    const Setting::Field field = setting.field(config);
    if (auto* const* number = std::get_if<double*>(&field)) {
      EXPECT_GE(**number, setting.min) << setting.key;
      EXPECT_LE(**number, setting.max) << setting.key;
    }
    EXPECT_FALSE(setting.help.empty()) << setting.key;
  }
}

TEST(Config, SaysWhatIsWrongAndWhatIsAllowed) {
  EXPECT_TRUE(contains(message_of("water.humidty", "0.5"), "did you mean 'water.humidity'?"));
  EXPECT_TRUE(contains(message_of("water.humidity", "1.5"), "between 0 and 1"));
  EXPECT_TRUE(contains(message_of("water.humidity", "nan"), "between 0 and 1"));
  EXPECT_TRUE(contains(message_of("water.humidity", "damp"), "'damp'"));
  EXPECT_TRUE(contains(message_of("iterations", "10.5"), "whole number"));
  EXPECT_TRUE(contains(message_of("model", "papr"), "did you mean 'paper'?"));
  EXPECT_TRUE(contains(message_of("species", "mapel"), "did you mean 'maple'?"));
  EXPECT_TRUE(contains(message_of("veins.secondary", "yes"), "true or false"));
}

std::string toml_refusal(const std::string& toml) {
  Config config;
  try {
    apply_toml(config, toml, "run.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    return error.what();
  }
  return "no error";
}

TEST(Config, NamesTheLineOfAWrongToml) {
  const std::string message = toml_refusal("dt = 0.1\n\n[water]\nhumidity = \"dry\"\n");
  EXPECT_TRUE(contains(message, "run.toml, line 4")) << message;
  EXPECT_NE(toml_refusal("dt = = 1"), "no error");
}

// Oracle: the numbers themselves.
TEST(Config, TakesListsOfNumbers) {
  Config config;
  set(config, "external.forces", "1, -2,3e-1");
  EXPECT_EQ(config.external.forces, (std::vector<double>{1, -2, 0.3}));
  set(config, "external.forces", "-0,1,1");
  EXPECT_FALSE(std::signbit(config.external.forces[0])) << "TOML reads -0 back as 0";
  set(config, "external.forces", "");
  EXPECT_TRUE(config.external.forces.empty());
  apply_toml(config, "[water]\ndry_region = [0, 0.5,\n  1, 0.25, -1, 2.5]", "run.toml");
  EXPECT_EQ(config.water.dry_region, (std::vector<double>{0, 0.5, 1, 0.25, -1, 2.5}));
  EXPECT_TRUE(contains(to_toml(config, true), "\ndry_region = [0, 0.5, 1, 0.25, -1, 2.5] # "));
  EXPECT_EQ(nlohmann::json::parse(to_json(config)).at("water.dry_region"),
            (nlohmann::json{0.0, 0.5, 1.0, 0.25, -1.0, 2.5}));
  EXPECT_EQ(config.water.dry_factor, 3.0);
}

TEST(Config, RefusesListsThatAreNone) {
  for (const char* text : {"1,2", "1,2,3,4", "1,2,", ",1,2", "1,,2", "1;2;3", "[1,2,3]", " ", "1,2,nan"})
    EXPECT_TRUE(contains(message_of("external.forces", text), "external.forces")) << text;
  EXPECT_TRUE(contains(message_of("external.forces", "1,2"), "a multiple of 3 numbers, not 2"));
  EXPECT_TRUE(contains(message_of("external.forces", "1,200,1"), "each number of external.forces must be"));
  EXPECT_TRUE(contains(message_of("water.dry_region", "0,0,1,1"), "6 numbers or more, or none, not 4"));
  EXPECT_TRUE(contains(toml_refusal("[water]\ndry_region = 3"), "line 2: water.dry_region must be a list"));
  EXPECT_TRUE(contains(toml_refusal("[water]\ndry_region = [0, 0, 1, 1, 2, \"x\"]"), "must be a list"));
  EXPECT_TRUE(contains(toml_refusal("[water]\nhumidity = [0.5]"), "must be a number"));
  std::string many = "1";
  for (int k = 0; k < 3005; ++k) many += ",1";
  EXPECT_TRUE(contains(message_of("water.dry_region", many), "3000 numbers at most"));
}

// Oracle: the library that reads TOML goes one call deeper for each part of a key, and for nothing in a list.
TEST(Config, RefusesKeysOfManyPartsButNotLongLists) {
  std::string list = "water.dry_region = [0.5", key = "a";
  for (int k = 0; k < 199; ++k) list += ", 0.5", key += ".1";
  EXPECT_EQ(toml_refusal(list + "]"), "no error");
  EXPECT_TRUE(contains(toml_refusal(key + " = 1"), "dots"));
  EXPECT_TRUE(contains(toml_refusal("a = [0.5, {" + key + " = 1}]"), "dots"));
}

TEST(Config, ReadsChangesOfARun) {
  Config config;
  apply_toml(config,
             "[[change]]\niteration = 40\n\"water.humidity\" = 0.2\nsprings.damping = 1\n"
             "[[change]]\niteration = 3\nwater = {humidity = 0.9}\n"
             "[[change]]\niteration = 40\nwater.humidity = 0.3\n",
             "run.toml");
  ASSERT_EQ(config.changes.size(), 3u);
  EXPECT_EQ(config.changes[0].iteration, 3);
  EXPECT_EQ(config.changes[1].key, "springs.damping");
  EXPECT_EQ(config.changes[2].value, "0.3");
  EXPECT_EQ(config.water.humidity, 0.5);
  EXPECT_EQ(config_after(config, 2).water.humidity, 0.5);
  EXPECT_EQ(config_after(config, 3).water.humidity, 0.9);
  EXPECT_EQ(config_after(config, 40).water.humidity, 0.3);
  EXPECT_EQ(config_after(config, 40).springs.damping, 1.0);
}

TEST(Config, NamesTheLineOfAWrongChange) {
  const auto refusal = [](const std::string& lines) { return toml_refusal("dt = 0.1\n" + lines); };
  EXPECT_TRUE(contains(refusal("[[change]]\niteration = 4\ndt = 0.2"), "run.toml, line 4: dt cannot change"));
  EXPECT_TRUE(contains(refusal("[[change]]\niteration = 4\nwater.humidty = 0.2"), "line 4: unknown setting"));
  EXPECT_TRUE(
      contains(refusal("[[change]]\niteration = 4\nwater.humidity = 2"), "line 4: water.humidity must"));
  EXPECT_TRUE(contains(refusal("[[change]]\niteration = -1\nwater.humidity = 1"), "iteration 0 to 1000000"));
  EXPECT_TRUE(contains(refusal("[[change]]\niteration = 2000000\nwater.humidity = 1"), "0 to 1000000"));
  EXPECT_TRUE(contains(refusal("[[change]]\niteration = 0.5\nwater.humidity = 1"), "line 2: iteration must"));
  EXPECT_TRUE(contains(refusal("[[change]]\nwater.humidity = 1"), "line 2: a [[change]] has no iteration"));
  EXPECT_TRUE(contains(refusal("[change]\niteration = 1"), "[[change]]"));
  EXPECT_TRUE(contains(refusal("change = [1]"), "line 2: change takes sections"));
}

}  // namespace
}  // namespace wilt
