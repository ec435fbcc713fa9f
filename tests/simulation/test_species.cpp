// The six species under the default model reach the figures that the method page states.
#include <gtest/gtest.h>

#include <numbers>

#include "wilt/leaf/species.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

class EverySpecies : public testing::TestWithParam<std::string> {
 protected:
  SimulationResult run(double external_scale) const {
    const Species& preset = species(GetParam());
    const Leaf leaf = make_leaf(preset.name, 1050, 1);
    Config config = default_config(preset);
    config.frames = 2;
    config.external.scale = external_scale;
    const Venation venation = find_venation(leaf, preset.secondary, venation_options(config));
    return simulate(leaf, venation, config);
  }
};
INSTANTIATE_TEST_SUITE_P(Species, EverySpecies, testing::ValuesIn(species_names()));

void expect_every_step_converged(const SimulationResult& result) {
  EXPECT_TRUE(result.completed) << result.stop_reason;
  ASSERT_EQ(result.steps.size(), 100u);
  for (const StepRow& step : result.steps) EXPECT_TRUE(step.converged) << step.iteration;
}

// Oracle: the acceptance figure, 0.002 of the leaf's length; the relief of a fresh leaf scores 0.0007 to
// 0.0014.
TEST_P(EverySpecies, WrinklesWithSwellingAlone) {
  const SimulationResult result = run(0.0);
  expect_every_step_converged(result);
  EXPECT_LT(result.metrics.front().wrinkle, 0.0015);
  EXPECT_GE(result.metrics.back().wrinkle, 0.002);
  EXPECT_LE(result.metrics.back().max_strain, 0.6);
}

// Oracle: the acceptance figures, 30 degrees of curl and no edge strained past 60 %.
TEST_P(EverySpecies, CurlsWithExternalForces) {
  const SimulationResult result = run(1.0);
  expect_every_step_converged(result);
  EXPECT_GE(result.metrics.back().curl * 180.0 / std::numbers::pi, 30.0);
  EXPECT_LE(result.metrics.back().max_strain, 0.6);
}

}  // namespace
}  // namespace wilt
