#include "wilt/leaf/presets.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"

namespace wilt {
namespace detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// A table of a preset that knows its file and its place in it, for messages; every key must be used.
class Section {
 public:
  Section(std::string file, std::string path, const toml::table& table)
      : file_(std::move(file)), path_(std::move(path)), table_(table) {}

  double number(std::string_view key, double low, double high) {
    const double value = node(key).value<double>().value_or(std::nan(""));
    if (!(value >= low && value <= high)) {
      fail(key, fmt::format("must be a number from {} to {}", low, high));
    }
    return value;
  }
  std::string text(std::string_view key) {
    const auto value = node(key).value<std::string>();
    if (!value || value->empty()) fail(key, "must be a text");
    return *value;
  }
  bool flag(std::string_view key) {
    const auto value = node(key).value_exact<bool>();
    if (!value) fail(key, "must be true or false");
    return *value;
  }
  std::array<int, 3> colour(std::string_view key) {
    const toml::array* values = node(key).as_array();
    std::array<int, 3> result{};
    bool good = values != nullptr && values->size() == 3;
    for (std::size_t k = 0; good && k < 3; ++k) {
      result[k] = static_cast<int>(values->get(k)->value<std::int64_t>().value_or(-1));
      good = result[k] >= 0 && result[k] <= 255;
    }
    if (!good) fail(key, "must be three integers from 0 to 255");
    return result;
  }
  bool has(std::string_view key) const { return table_.contains(key); }
  Section section(std::string_view key) {
    const toml::table* table = node(key).as_table();
    if (table == nullptr) fail(key, "must be a table");
    return Section(file_, name_of(key), *table);
  }
  const toml::array& array(std::string_view key) {
    const toml::array* values = node(key).as_array();
    if (values == nullptr || values->empty()) fail(key, "must be a list");
    return *values;
  }
  void expect_all_used() const {
    for (const auto& [key, value] : table_) {
      if (used_.count(std::string(key.str())) == 0) fail(key.str(), "is unknown here: remove it");
    }
  }
  [[noreturn]] void fail(std::string_view key, std::string_view why) const {
    throw Error(ErrorCode::configuration, fmt::format("presets/{}.toml: {} {}", file_, name_of(key), why));
  }

 private:
  toml::node_view<const toml::node> node(std::string_view key) {
    used_.insert(std::string(key));
    return table_[key];
  }
  std::string name_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }

  std::string file_, path_;
  const toml::table& table_;
  std::set<std::string> used_;
};

MarginNode read_node(const toml::node& source, const Section& section) {
  const toml::array* values = source.as_array();
  if (values == nullptr || values->size() < 2 || values->size() > 3 || !values->get(0)->is_number() ||
      !values->get(1)->is_number()) {
    section.fail("nodes", "must hold [across, along] or [across, along, kind]");
  }
  MarginNode node;
  node.at = Vec2(*values->get(0)->value<double>(), *values->get(1)->value<double>());
  if (values->size() == 3) {
    const std::string kind = values->get(2)->value<std::string>().value_or("");
    const std::map<std::string, NodeKind> kinds{
        {"tip", NodeKind::tip}, {"tooth", NodeKind::tooth}, {"sinus", NodeKind::sinus}};
    const auto found = kinds.find(kind);
    if (found == kinds.end())
      section.fail("nodes", fmt::format("has a node of the kind '{}', not tip, tooth or sinus", kind));
    node.kind = found->second;
  }
  return node;
}

LobeNodes read_lobe(const std::string& file, const toml::node& source) {
  if (!source.is_table()) {
    throw Error(ErrorCode::configuration,
                fmt::format("presets/{}.toml: outline.group must be a table", file));
  }
  Section section(file, "outline.group", *source.as_table());
  LobeNodes lobe;
  lobe.angle = section.number("angle", 0.0, 180.0) * kDegree;
  lobe.length = section.number("length", 0.05, 2.0);
  for (const toml::node& node : section.array("nodes")) lobe.nodes.push_back(read_node(node, section));
  section.expect_all_used();
  return lobe;
}

OutlineRule read_outline(const std::string& file, Section section) {
  OutlineRule rule;
  rule.blunt = section.number("blunt", 0.0, 0.1);
  rule.vary = section.number("vary", 0.0, 0.2);
  rule.wave = section.number("wave", 0.0, 0.05);
  rule.asymmetry = section.number("asymmetry", 0.0, 0.5);
  rule.bend = section.number("bend", 0.0, 0.5);
  for (const toml::node& group : section.array("group")) rule.lobes.push_back(read_lobe(file, group));
  if (section.has("teeth")) {
    Section teeth = section.section("teeth");
    rule.teeth.pitch = teeth.number("pitch", 0.005, 0.5);
    rule.teeth.depth = teeth.number("depth", 0.0, 1.0);
    rule.teeth.lean = teeth.number("lean", 0.0, 2.0);
    rule.teeth.round = teeth.number("round", 0.0, 1.0);
    rule.teeth.minor = teeth.number("minor", 0.0, 0.9);
    rule.teeth.start = teeth.number("start", 0.0, 1.0);
    rule.teeth.end = teeth.number("end", 0.0, 1.0);
    teeth.expect_all_used();
  }
  section.expect_all_used();
  return rule;
}

SecondaryVeinRule read_secondary(Section section) {
  SecondaryVeinRule rule;
  rule.angle = section.number("angle", 5.0, 90.0) * kDegree;
  rule.angle_tip = section.number("angle_tip", 5.0, 90.0) * kDegree;
  rule.spacing = section.number("spacing", 0.01, 2.0);
  rule.alternate = section.flag("alternate");
  rule.curvature = section.number("curvature", -2.0, 2.0);
  section.expect_all_used();
  return rule;
}

Physiology read_physiology(Section section) {
  Physiology physiology;
  physiology.mass_min = section.number("mass_min", 0.01, 100.0);
  physiology.mass_max = section.number("mass_max", physiology.mass_min, 100.0);
  physiology.leaf_parameter = section.number("leaf_parameter", 0.0, 1.0);
  physiology.dehydration_rate = section.number("dehydration_rate", 0.0, 1.0);
  physiology.force_range = section.number("force_range", 0.01, 100.0);
  physiology.dryness_scale = section.number("dryness_scale", 0.01, 1.0);
  physiology.shrinkage = section.number("shrinkage", 0.0, 10.0);
  physiology.roll = section.number("roll", -200.0, 200.0);
  section.expect_all_used();
  return physiology;
}

Pigmentation read_pigments(Section section) {
  Pigmentation pigments;
  pigments.chlorophyll = section.number("chlorophyll", 0.0, 120.0);
  pigments.chlorophyll_left = section.number("chlorophyll_left", 0.0, 1.0);
  pigments.carotenoids = section.number("carotenoids", 0.0, 30.0);
  pigments.carotenoids_left = section.number("carotenoids_left", 0.0, 1.0);
  pigments.anthocyanin = section.number("anthocyanin", 0.0, 60.0);
  pigments.brown = section.number("brown", 0.0, 2.0);
  pigments.structure = section.number("structure", 1.0, 4.0);
  pigments.structure_dry = section.number("structure_dry", pigments.structure, 4.0);
  pigments.water = section.number("water", 0.0, 0.1);
  pigments.dry_matter = section.number("dry_matter", 0.0, 0.05);
  pigments.vein_pigment = section.number("vein_pigment", 0.0, 1.0);
  pigments.vein_brown = section.number("vein_brown", 0.0, 2.0);
  pigments.margin_lead = section.number("margin_lead", 0.0, 1.0);
  pigments.patchiness = section.number("patchiness", 0.0, 0.5);
  pigments.stalk = section.colour("stalk");
  section.expect_all_used();
  return pigments;
}

std::vector<Preset> parse_all() {
  std::vector<Preset> presets;
  for (const PresetText& text : preset_texts()) presets.push_back(parse_preset(text));
  return presets;
}

}  // namespace

Preset parse_preset(const PresetText& source) {
  const std::string file(source.name);
  toml::table table;
  try {
    table = toml::parse(source.text);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorCode::configuration, fmt::format("presets/{}.toml, line {}: {}", file,
                                                      error.source().begin.line, error.description()));
  }
  Section root(file, "", table);
  Preset preset;
  preset.species.name = root.text("name");
  preset.species.botanical = root.text("botanical");
  preset.species.common = root.text("common");
  preset.species.length = root.number("length", 1e-3, 2.0);
  preset.species.stalk_length = root.number("stalk_length", 0.0, 5.0);
  preset.species.stalk_radius = root.number("stalk_radius", 1e-4, 0.1);
  preset.species.secondary = read_secondary(root.section("secondary"));
  preset.species.physiology = read_physiology(root.section("physiology"));
  preset.species.pigments = read_pigments(root.section("pigments"));
  if (root.has("outline")) preset.outline = read_outline(file, root.section("outline"));
  root.expect_all_used();
  return preset;
}

const Preset& preset(std::string_view name) {
  static const std::vector<Preset> presets = parse_all();
  for (const Preset& candidate : presets) {
    if (candidate.species.name == name) return candidate;
  }
  throw Error(ErrorCode::input,
              fmt::format("there is no species '{}'{}; the species are {}", name,
                          did_you_mean(name, species_names()), fmt::join(species_names(), ", ")));
}

}  // namespace detail

const std::vector<std::string>& species_names() {
  static const std::vector<std::string> names{"maple", "poplar", "tilia", "ivy", "willow", "grape"};
  return names;
}

const Species& species(std::string_view name) {
  return detail::preset(name).species;
}

}  // namespace wilt
