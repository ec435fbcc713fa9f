#include <gtest/gtest.h>

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

TEST(Config, NamesTheLineOfAWrongToml) {
  Config config;
  try {
    apply_toml(config, "dt = 0.1\n\n[water]\nhumidity = \"dry\"\n", "run.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "run.toml, line 4")) << error.what();
  }
  EXPECT_THROW(apply_toml(config, "dt = = 1", "run.toml"), Error);
}

}  // namespace
}  // namespace wilt
