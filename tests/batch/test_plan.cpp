#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "wilt/batch/plan.hpp"

namespace wilt {
namespace {

Plan plan_of(const std::string& more, const std::string& top = "count = 4000") {
  return Plan("leaf = \"ivy\"\n" + top + "\n[write]\nfiles = [\"leaf.glb\"]\n" + more, "plan.toml", "");
}

std::vector<double> humidities(const Plan& plan) {
  std::vector<double> values;
  for (int i = 0; i < plan.count(); ++i) values.push_back(plan.item(i).config.water.humidity);
  return values;
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

Moments moments_of(const std::vector<double>& values) {
  Moments m;
  for (const double v : values) m.mean += v / double(values.size());
  for (const double v : values) m.deviation += (v - m.mean) * (v - m.mean) / double(values.size());
  m.deviation = std::sqrt(m.deviation);
  return m;
}

// Oracle: the moments of the distributions; bands of four standard errors.
TEST(Plan, DrawsUniformAndNormalNumbers) {
  const Moments uniform =
      moments_of(humidities(plan_of("[settings]\nwater.humidity = {uniform = [0.2, 0.8]}")));
  EXPECT_NEAR(uniform.mean, 0.5, 4 * 0.1732 / std::sqrt(4000));
  EXPECT_NEAR(uniform.deviation, 0.6 / std::sqrt(12.0), 0.005);
  const std::vector<double> values =
      humidities(plan_of("[settings]\nwater.humidity = {normal = [0.5, 0.1], min = 0.3}"));
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.3);
  // Cut at two deviations below: the mean rises by phi(2) / Phi(2) deviations.
  EXPECT_NEAR(moments_of(values).mean, 0.5 + 0.1 * 0.05399 / 0.97725, 4 * 0.1 / std::sqrt(4000));
}

// Oracle: the definition: n strata of equal width hold one value each, along every side.
TEST(Plan, FillsEveryStratumOfALatinHypercubeOnce) {
  const Plan plan =
      plan_of("[settings]\nwater.humidity = {latin = [0.2, 0.8]}\nwater.temperature_c = {latin = [10, 30]}",
              "count = 500");
  std::set<int> humidity, temperature;
  double product = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Config config = plan.item(i).config;
    const double h = (config.water.humidity - 0.2) / 0.6, t = (config.water.temperature_c - 10) / 20;
    humidity.insert(static_cast<int>(h * 500));
    temperature.insert(static_cast<int>(t * 500));
    product += (h - 0.5) * (t - 0.5) / 500;
  }
  EXPECT_EQ(humidity.size(), 500u);
  EXPECT_EQ(temperature.size(), 500u);
  EXPECT_NEAR(product * 12, 0.0, 4 / std::sqrt(500));  // the sides are shuffled apart
}

// Oracle: counting the cells.
TEST(Plan, GoesThroughEveryCellOfItsGrids) {
  const Plan plan(
      "leaf = {grid = [\"ivy\", \"maple\"]}\n[settings]\nmodel = {grid = [\"cell\", \"paper\"]}\n"
      "water.humidity = {grid = [0.1, 0.2, 0.3]}\nseed = 5\n[write]\nfiles = \"leaf.glb\"",
      "plan.toml", "");
  ASSERT_EQ(plan.count(), 12);
  std::set<std::string> cells;
  for (int i = 0; i < 12; ++i) {
    const Item item = plan.item(i);
    cells.insert(item.leaf.leaf + item.config.model + std::to_string(item.config.water.humidity));
    EXPECT_EQ(item.config.seed, 5);
  }
  EXPECT_EQ(cells.size(), 12u);
}

TEST(Plan, ChoosesByWeight) {
  const Plan plan(
      "leaf = {choice = [\"ivy\", \"maple\"], weights = [3, 1]}\ncount = 4000\n[write]\nfiles = \"leaf.glb\"",
      "plan.toml", "");
  int ivy = 0;
  for (int i = 0; i < 4000; ++i) ivy += plan.item(i).leaf.leaf == "ivy" ? 1 : 0;
  EXPECT_NEAR(ivy, 3000, 4 * std::sqrt(4000 * 0.75 * 0.25));
}

TEST(Plan, DrawsWholeNumbersWithBothEnds) {
  const Plan plan = plan_of("[settings]\niterations = {uniform = [3, 5]}", "count = 3000");
  std::map<std::int64_t, int> counts;
  for (int i = 0; i < 3000; ++i) ++counts[plan.item(i).config.iterations];
  ASSERT_EQ(counts.size(), 3u);
  for (const int value : {3, 4, 5}) EXPECT_NEAR(counts[value], 1000, 4 * std::sqrt(3000 * 2.0 / 9.0));
}

// Invariance: another key, and more items, leave what an item had.
TEST(Plan, ItemDependsOnSeedAndNumberAlone) {
  const std::string humidity = "[settings]\nwater.humidity = {uniform = [0, 1]}\n";
  const std::vector<double> one = humidities(plan_of(humidity, "count = 20"));
  const std::vector<double> more = humidities(plan_of(
      humidity + "water.temperature_c = {uniform = [10, 30]}\n[pictures]\nazimuth = {uniform = [0, 90]}"));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], more[i]) << i;
  const std::vector<double> other = humidities(plan_of(humidity, "count = 20\nseed = 2"));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NE(one[i], other[i]) << i;
  std::set<std::int64_t> seeds;
  const Plan plan = plan_of("");
  for (int i = 0; i < 1000; ++i) seeds.insert(plan.item(i).config.seed);
  EXPECT_EQ(seeds.size(), 1000u);  // individuals of their own
}

TEST(Plan, ShardsShareOutTheItems) {
  for (int item = 0; item < 100; ++item) {
    int owners = 0;
    for (int index = 1; index <= 7; ++index) owners += Shard{index, 7}.has(item) ? 1 : 0;
    EXPECT_EQ(owners, 1) << item;
  }
  EXPECT_EQ(parse_shard("3/7").index, 3);
  EXPECT_EQ(parse_shard("3/7").of, 7);
}

}  // namespace
}  // namespace wilt
