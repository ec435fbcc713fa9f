#include "wilt/batch/plan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "wilt/batch/plan_contents.hpp"
#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/random.hpp"

namespace wilt {

using detail::Distribution;
using detail::Spread;
using detail::Variable;

namespace {

constexpr std::uint64_t kLargestPlan = std::uint64_t{16} << 20;  // bytes

double radians(const std::string& degrees) {
  return std::strtod(degrees.c_str(), nullptr) * std::numbers::pi / 180.0;
}

// Which of `count` strata each item draws from: every one once.
std::vector<int> shuffled_strata(int count, std::uint64_t seed, const std::string& key) {
  std::vector<int> strata(static_cast<std::size_t>(count));
  std::iota(strata.begin(), strata.end(), 0);
  Random random(seed, "strata " + key);
  for (int i = count - 1; i > 0; --i)
    std::swap(strata[static_cast<std::size_t>(i)], strata[static_cast<std::size_t>(random.index(i + 1))]);
  return strata;
}

}  // namespace

struct Plan::Impl {
  detail::PlanContents contents;
  std::map<std::string, std::vector<int>> strata;  // of the sides of the Latin hypercube, by key

  // The value of every key for an item.
  std::map<std::string, std::string> values_of(int number) const {
    std::map<std::string, std::string> values;
    std::int64_t cell = number % grid_cells(contents);
    for (auto variable = contents.variables.rbegin(); variable != contents.variables.rend(); ++variable) {
      const Distribution& d = variable->distribution;
      std::size_t place = 0;
      if (d.spread == Spread::grid) {
        place = static_cast<std::size_t>(cell) % d.values.size();
        cell /= static_cast<std::int64_t>(d.values.size());
      }
      const auto side = strata.find(variable->key);
      const int stratum = side == strata.end() ? 0 : side->second[static_cast<std::size_t>(number)];
      values[variable->key] =
          detail::draw(d, variable->key, contents.seed, number, place, stratum, contents.count);
    }
    return values;
  }
};

Plan::Plan(std::string_view toml, const std::string& source, const std::filesystem::path& folder) {
  auto impl = std::make_unique<Impl>();
  impl->contents = detail::read_contents(toml, source, folder);
  for (const Variable& variable : impl->contents.variables) {
    if (variable.distribution.spread == Spread::latin)
      impl->strata[variable.key] = shuffled_strata(impl->contents.count, impl->contents.seed, variable.key);
  }
  impl_ = std::move(impl);
}
Plan::Plan(Plan&&) noexcept = default;
Plan::~Plan() = default;

int Plan::count() const {
  return impl_->contents.count;
}

const Outputs& Plan::outputs() const {
  return impl_->contents.outputs;
}

const std::string& Plan::text() const {
  return impl_->contents.text;
}

Item Plan::item(int number) const {
  WILT_CHECK(number >= 0 && number < count(), number);
  const detail::PlanContents& plan = impl_->contents;
  std::map<std::string, std::string> values = impl_->values_of(number);
  Item item;
  item.number = number;
  for (const Variable& variable : plan.variables) {
    if (variable.distribution.spread != Spread::fixed)
      item.chosen.push_back({variable.key, values[variable.key]});
  }
  const auto [seed, drawn] = values.try_emplace("seed");
  if (drawn) {
    Random random(plan.seed, fmt::format("item {} seed", number));
    seed->second = fmt::format("{}", 1 + random.index(std::numeric_limits<int>::max()));
    item.chosen.push_back({"seed", seed->second});
  }

  item.picture.width = plan.outputs.pictures.width;
  item.picture.height = plan.outputs.pictures.height;
  item.picture.samples = plan.outputs.pictures.samples;
  double sun_azimuth = kSunAzimuth, sun_elevation = kSunElevation;
  std::vector<Assignment> assignments;
  for (const auto& [key, value] : values) {
    if (key == "leaf") {
      item.leaf.leaf = is_species(value) ? value : (plan.folder / value).string();
    } else if (key == "pictures.azimuth") {
      item.picture.view.azimuth = radians(value);
    } else if (key == "pictures.elevation") {
      item.picture.view.elevation = radians(value);
    } else if (key == "pictures.sun_azimuth") {
      sun_azimuth = radians(value);
    } else if (key == "pictures.sun_elevation") {
      sun_elevation = radians(value);
    } else if (key == "pictures.background") {
      item.picture.background = detail::parse_colour(value);
    } else {
      assignments.push_back({key, value});
    }
  }
  item.picture.lighting.sun.direction = sun_direction(sun_azimuth, sun_elevation);
  const bool from_species = is_species(item.leaf.leaf);
  if (!from_species) {
    item.leaf.read = plan.read;
    item.leaf.veins = plan.veins;
  }
  item.config = resolve_config(from_species ? item.leaf.leaf : "generic", "", "", assignments);
  take_size_and_seed(item.leaf, item.config);
  return item;
}

Plan read_plan(const std::filesystem::path& file) {
  return Plan(read_file(file.string(), kLargestPlan), file.string(), file.parent_path());
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto [slash, bad_index] = std::from_chars(text.data(), end, shard.index);
  const bool parted = bad_index == std::errc() && slash != end && *slash == '/';
  const auto [rest, bad_of] = std::from_chars(parted ? slash + 1 : end, end, shard.of);
  if (!parted || bad_of != std::errc() || rest != end || shard.index < 1 || shard.of < shard.index)
    throw Error(ErrorCode::configuration,
                fmt::format("--shard takes i/N with i from 1 to N, for example 3/7, not '{}'", text));
  return shard;
}

}  // namespace wilt
