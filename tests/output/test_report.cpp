#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "output/sample_leaf.hpp"
#include "wilt/core/version.hpp"
#include "wilt/output/report.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

SimulationResult sample_result() {
  SimulationResult result;
  result.metrics = {{0, 0.0, 0.0, 1.0, 1.0, 0.0, 0}, {100, 0.01, std::numbers::pi / 3.0, 0.9, 0.7, 0.25, 2}};
  result.steps = {{1, 0.01, 3, 40, 1e-9, true, 0.1, 0.2, 0.3, 55.5}};
  result.forces = {{1, Region::tip, 1.0, 0.5, 0.25, 0.125, 0.75, 0.1},
                   {1, Region::mesophyll, 1e-7, 2.0 / 3.0, 0, 0, 0, -4}};
  result.positions_hash = "0123456789abcdef";
  return result;
}

// Oracle: the product's contract, key by key.
TEST(Report, HasTheKeysThatScriptsRelyOn) {
  const Leaf leaf = test::sample_leaf();
  const Json report = Json::parse(report_json(leaf, test::sample_venation(leaf), sample_result(),
                                              R"({"seed": 18446744073709551615})", {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(keys(report), (std::vector<std::string>{"wilt", "config", "leaf", "timings_s", "steps", "frames",
                                                    "metrics", "positions_hash"}));
  EXPECT_EQ(report["timings_s"].dump(),
            R"({"leaf":1.0,"geodesics":2.0,"embedding":3.0,"venation":4.0,"simulation":5.0,"output":6.0})");
  EXPECT_EQ(keys(report["steps"][0]),
            (std::vector<std::string>{"iteration", "dt", "newton", "linear", "residual", "converged",
                                      "kinetic", "elastic", "bending", "water"}));
  EXPECT_EQ(keys(report["frames"][0]),
            (std::vector<std::string>{"iteration", "wrinkle", "curl", "area_ratio", "projected_area_ratio",
                                      "max_strain", "self_intersections"}));
  EXPECT_EQ(report["wilt"], version());
  EXPECT_EQ(report["config"].dump(), R"({"seed":18446744073709551615})");
  EXPECT_EQ(report["positions_hash"], "0123456789abcdef");
  EXPECT_EQ(report["leaf"]["vertices"], leaf.mesh.num_vertices());
  EXPECT_EQ(report["leaf"]["boundary_vertices"], 2 * (test::kColumns + test::kRows));
}

// Oracle: analytic; pi / 3 is 60 degrees, and the metrics are those of the last frame.
TEST(Report, GivesTheLastFramesMetricsAndDegrees) {
  const Leaf leaf = test::sample_leaf();
  const Json report = Json::parse(report_json(leaf, test::sample_venation(leaf), sample_result(), "{}", {}));
  EXPECT_EQ(report["metrics"], report["frames"][1]);
  EXPECT_NEAR(report["metrics"]["curl"].get<double>(), 60.0, 1e-12);
  EXPECT_EQ(report["steps"][0]["newton"], 3);
  EXPECT_EQ(report["steps"][0]["water"], 55.5);
}

// Oracle: negative. Still JSON, with null in the number's place, and the reason for the stop.
TEST(Report, SaysWhyARunStopped) {
  const Leaf leaf = test::sample_leaf();
  SimulationResult result = sample_result();
  result.completed = false;
  result.stop_reason = "not finite at iteration 7";
  result.steps[0].residual = std::numeric_limits<double>::quiet_NaN();
  const Json report = Json::parse(report_json(leaf, test::sample_venation(leaf), result, "{}", {}));
  EXPECT_EQ(report["stopped"], "not finite at iteration 7");
  EXPECT_TRUE(report["steps"][0]["residual"].is_null());
  EXPECT_THROW(report_json(leaf, test::sample_venation(leaf), result, "no JSON", {}), std::logic_error);
}

// Oracle: the text, written by hand.
TEST(Forces, AreATable) {
  EXPECT_EQ(forces_csv(sample_result()),
            "iteration,region,elastic,damping,swelling,external,water,pressure\n"
            "1,tip,1,0.5,0.25,0.125,0.75,0.1\n"
            "1,mesophyll,1e-07,0.666666667,0,0,0,-4\n");
}

}  // namespace
}  // namespace wilt
