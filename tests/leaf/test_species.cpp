#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/presets.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

std::string message_of(const std::function<void()>& action, ErrorCode code) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

// Oracle: Table 1 of the paper, whose water loss is half of T H K at 20 C and 50 %.
TEST(Species, HoldTableOne) {
  const std::vector<std::string> names{"maple", "poplar", "tilia", "ivy", "willow", "grape"};
  ASSERT_EQ(species_names(), names);
  const double mass_min[] = {.70, .75, .85, .80, .75, .80};
  const double mass_max[] = {1.50, 1.55, 1.65, 1.00, 1.55, 1.50};
  const double range[] = {1.0, 1.0, 0.5, 1.0, 0.8, 1.0};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Physiology& physiology = species(names[k]).physiology;
    EXPECT_EQ(physiology.mass_min, mass_min[k]) << names[k];
    EXPECT_EQ(physiology.mass_max, mass_max[k]) << names[k];
    EXPECT_EQ(physiology.force_range, range[k]) << names[k];
    EXPECT_NEAR(physiology.dehydration_rate, 0.5 * 20.0 * 0.5 * physiology.leaf_parameter, 1e-15) << names[k];
    EXPECT_EQ(physiology.shrinkage, names[k] == "maple" || names[k] == "tilia" ? 2.0 : 1.0) << names[k];
  }
}

// Oracle: the water balance itself. At iteration 100 every vertex has lost 10 w_loss of its first 0.8 m; mass
// falls linearly with the distance to the nearest main vein. The band is what the calibration promises.
TEST(Species, AreNearlyDryAtIterationHundred) {
  for (const std::string& name : species_names()) {
    const Leaf leaf = make_leaf(name, 800, 1);
    const BladeOutline blade = blade_outline(name, 1);
    double apex = 0.0;
    for (const Vec2& tip : blade.tips) apex = std::max(apex, tip.norm());
    const double scale = species(name).length / apex;
    std::vector<double> distance;
    for (Eigen::Index i = 0; i < leaf.positions.rows(); ++i) {
      const Vec2 p = leaf.positions.row(i).head<2>().transpose();
      double nearest = 1e300;
      for (const Vec2& tip : blade.tips) {
        const Vec2 u = scale * tip;
        nearest = std::min(nearest, (p - std::clamp(p.dot(u) / u.squaredNorm(), 0.0, 1.0) * u).norm());
      }
      distance.push_back(nearest);
    }
    const double farthest = *std::max_element(distance.begin(), distance.end());
    const Physiology& physiology = species(name).physiology;
    double water = 0.0;
    for (const double d : distance) {
      const double near = 1.0 - d / farthest;
      water += 0.8 * (physiology.mass_min * (1.0 - near) + physiology.mass_max * near);
    }
    const double lost = 10.0 * physiology.dehydration_rate * static_cast<double>(distance.size());
    const double dryness = lost / (physiology.dryness_scale * water);
    EXPECT_GE(dryness, 0.9) << name;
    EXPECT_LE(dryness, 1.0) << name;
  }
}

TEST(Species, UnknownNameIsRefusedWithTheNearest) {
  const std::string message = message_of([] { species("mapel"); }, ErrorCode::input);
  expect_contains(message, "'mapel'");
  expect_contains(message, "did you mean 'maple'");
  expect_contains(message, "willow");
  EXPECT_EQ(species("generic").name, "generic");
  expect_contains(message_of([] { blade_outline("generic", 1); }, ErrorCode::input), "generic");
}

TEST(Species, BrokenPresetsAreNamed) {
  using detail::parse_preset;
  const auto& texts = detail::preset_texts();
  const std::string good(texts[0].text);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  };
  const auto complaint = [](const std::string& text) {
    return message_of([&] { parse_preset({"maple", text}); }, ErrorCode::configuration);
  };
  expect_contains(complaint("name = \"maple\"\nlength = = 3"), "presets/maple.toml, line 2");
  expect_contains(complaint(with("mass_min = 0.70", "mass_min = -1.0")), "physiology.mass_min");
  expect_contains(complaint(with("mass_min = 0.70", "")), "physiology.mass_min");
  expect_contains(complaint(with("mass_min = 0.70", "mass_min = 0.70\nmas_min = 1.0")),
                  "physiology.mas_min is unknown");
  expect_contains(complaint(with("alternate = false", "alternate = 1")), "secondary.alternate");
  expect_contains(complaint(with("\"tooth\"", "\"fang\"")), "'fang'");
  expect_contains(complaint(with("chlorophyll = ", "chlorophyll = -")), "pigments.chlorophyll");
  expect_contains(complaint(with("structure_dry = 2", "structure_dry = 0")), "pigments.structure_dry");
  expect_contains(complaint(with("stalk = [", "stalk = [300, ")), "pigments.stalk");
}

}  // namespace
}  // namespace wilt
