#include "wilt/simulation/config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/simulation/deformation_model.hpp"

namespace wilt {
namespace {

using Words = std::vector<std::string>;

// A captureless lambda that names one member of Config.
#define WILT_FIELD(member) [](Config& c) -> Setting::Field { return &c.member; }

std::vector<Setting> make_settings() {
  return {
      {"model", "", "deformation model", 0, 0, model_names(), WILT_FIELD(model)},
      {"species", "", "preset that the defaults below come from", 0, 0, {}, WILT_FIELD(species)},
      {"vertices",
       "",
       "vertices of the mesh; a mesh file keeps its own unless --vertices is given",
       200,
       1e6,
       {},
       WILT_FIELD(vertices)},
      {"seed", "", "varies the individual leaf and the noise", 0, 9e15, {}, WILT_FIELD(seed)},
      {"iterations", "", "time steps", 0, 1e6, {}, WILT_FIELD(iterations)},
      {"frames", "", "frames written, the leaf at rest among them", 2, 100000, {}, WILT_FIELD(frames)},
      {"dt", "time units", "time step", 1e-4, 1, {}, WILT_FIELD(dt)},
      {"pin", "", "what is held: the petiole's one-ring, or nothing (results in the petiole's frame)", 0, 0,
       Words{"ring", "free"}, WILT_FIELD(pin)},
      {"clip.seconds", "s", "playing time of the animation", 0.01, 3600, {}, WILT_FIELD(clip.seconds)},
      {"clip.hours",
       "h",
       "drying time that 100 iterations stand for; stated in the files",
       0.01,
       1e5,
       {},
       WILT_FIELD(clip.hours)},
      {"veins.peaks", "", "rule for peaks of the margin profile", 0, 0, Words{"prominence", "window"},
       WILT_FIELD(veins.peaks)},
      {"veins.window_vertices",
       "margin vertices",
       "half window of the rule 'window'",
       1,
       10000,
       {},
       WILT_FIELD(veins.window_vertices)},
      {"veins.window_length",
       "perimeters",
       "window of the rule 'prominence'",
       0,
       0.5,
       {},
       WILT_FIELD(veins.window_length)},
      {"veins.min_prominence",
       "max(d)",
       "least prominence of a peak",
       0,
       1,
       {},
       WILT_FIELD(veins.min_prominence)},
      {"veins.geodesics", "", "distances of the embedding (veins themselves are always exact)", 0, 0,
       Words{"fast", "exact"}, WILT_FIELD(veins.geodesics)},
      {"veins.full_embedding_up_to",
       "vertices",
       "above, landmarks are embedded",
       100,
       50000,
       {},
       WILT_FIELD(veins.full_embedding_up_to)},
      {"veins.landmarks", "", "landmarks of a large embedding", 4, 5000, {}, WILT_FIELD(veins.landmarks)},
      {"veins.secondary", "", "draw secondary veins", 0, 0, {}, WILT_FIELD(veins.secondary)},
      {"mass.min", "mass", "m_min: cell mass far from the veins", 1e-3, 1e3, {}, WILT_FIELD(mass.min)},
      {"mass.max", "mass", "m_max: cell mass on the veins", 1e-3, 1e3, {}, WILT_FIELD(mass.max)},
      {"mass.tau", "", "exponent of the mass distribution", 1e-3, 1, {}, WILT_FIELD(mass.tau)},
      {"mass.water_fraction", "", "w / m at the start", 0.05, 0.99, {}, WILT_FIELD(mass.water_fraction)},
      {"water.temperature_c", "C", "cell: air temperature", -20, 60, {}, WILT_FIELD(water.temperature_c)},
      {"water.humidity", "", "cell: relative humidity of the air", 0, 1, {}, WILT_FIELD(water.humidity)},
      {"water.loss_rate",
       "mass / time unit",
       "w_loss of a cell (cell: at 20 C and 50 %)",
       0,
       10,
       {},
       WILT_FIELD(water.loss_rate)},
      {"water.diffusion", "", "lambda of the permeation", 0, 100, {}, WILT_FIELD(water.diffusion)},
      {"water.dryness_scale",
       "",
       "share of the first water whose loss counts as dry",
       1e-3,
       1,
       {},
       WILT_FIELD(water.dryness_scale)},
      {"pressure.cell_constant",
       "",
       "c of the elastic modulus c / (1 - 2 mu)",
       0,
       1,
       {},
       WILT_FIELD(pressure.cell_constant)},
      {"pressure.poisson_ratio", "", "mu", 0, 0.4999, {}, WILT_FIELD(pressure.poisson_ratio)},
      {"springs.stiffness", "force / length", "k_s", 1e-3, 1e6, {}, WILT_FIELD(springs.stiffness)},
      {"springs.damping", "force time / length", "k_d", 0, 1e3, {}, WILT_FIELD(springs.damping)},
      {"springs.vein_factor",
       "",
       "cell: stiffness of springs along veins over the others'",
       1,
       1e3,
       {},
       WILT_FIELD(springs.vein_factor)},
      {"swelling.coefficient", "", "k_p", 0, 100, {}, WILT_FIELD(swelling.coefficient)},
      {"external.variant", "", "column of Table 2 for a leaf of seven tips", 0, 0,
       Words{"a", "b", "c", "d", "e", "f"}, WILT_FIELD(external.variant)},
      {"external.range", "1 / length", "K_r", 0, 100, {}, WILT_FIELD(external.range)},
      {"external.growth",
       "1 / time unit",
       "kappa: k_r over the first force",
       0,
       100,
       {},
       WILT_FIELD(external.growth)},
      {"external.scale",
       "",
       "multiplies all external forces; 0 switches them off",
       0,
       100,
       {},
       WILT_FIELD(external.scale)},
      {"bending.stiffness",
       "",
       "cell: k_b for a wrinkle length of 0.15 at S = 5",
       0,
       10,
       {},
       WILT_FIELD(bending.stiffness)},
      {"bending.wrinkle_length",
       "sqrt(blade area)",
       "cell: wrinkle length l_w",
       0.01,
       2,
       {},
       WILT_FIELD(bending.wrinkle_length)},
      {"bending.turgor_loss",
       "",
       "cell: share of the bending stiffness that goes with the turgor",
       0,
       1,
       {},
       WILT_FIELD(bending.turgor_loss)},
      {"bending.vein_factor",
       "",
       "cell: bending stiffness of veins over the lamina's",
       1,
       1e4,
       {},
       WILT_FIELD(bending.vein_factor)},
      {"shrinkage.amount", "", "cell: s of the differential strain", 0, 10, {}, WILT_FIELD(shrinkage.amount)},
      {"shrinkage.vein_gap",
       "",
       "cell: weight of the lamina between veins",
       0,
       10,
       {},
       WILT_FIELD(shrinkage.vein_gap)},
      {"shrinkage.margin", "", "cell: weight of the margin", 0, 10, {}, WILT_FIELD(shrinkage.margin)},
      {"shrinkage.noise", "", "cell: weight of the smooth noise", 0, 10, {}, WILT_FIELD(shrinkage.noise)},
      {"strain_limit.threshold",
       "",
       "cell: strain at which springs begin to stiffen",
       0,
       1,
       {},
       WILT_FIELD(strain_limit.threshold)},
      {"strain_limit.stiffness",
       "",
       "cell: how fast they stiffen, in units of k_s",
       0,
       1e5,
       {},
       WILT_FIELD(strain_limit.stiffness)},
      {"strain_limit.area",
       "",
       "cell: share of its rest area below which a triangle resists",
       0.01,
       0.99,
       {},
       WILT_FIELD(strain_limit.area)},
      {"gravity.strength",
       "length / time unit^2",
       "cell: acceleration of gravity",
       0,
       10,
       {},
       WILT_FIELD(gravity.strength)},
      {"gravity.petiole_stiffness",
       "",
       "cell: bending stiffness of the fresh petiole, relative",
       0.01,
       1e6,
       {},
       WILT_FIELD(gravity.petiole_stiffness)},
      {"gravity.petiole_turgor_loss",
       "",
       "cell: share of it that goes with the turgor",
       0,
       0.999,
       {},
       WILT_FIELD(gravity.petiole_turgor_loss)},
      {"reference.vertices",
       "",
       "cell: n_ref, the vertex count that masses and forces are stated for",
       10,
       1e6,
       {},
       WILT_FIELD(reference.vertices)},
      {"solver.tolerance",
       "",
       "relative residual of the midpoint equation",
       1e-12,
       1e-2,
       {},
       WILT_FIELD(solver.tolerance)},
      {"solver.max_newton",
       "",
       "Newton iterations before the step is halved",
       1,
       1000,
       {},
       WILT_FIELD(solver.max_newton)},
      {"solver.max_halvings",
       "",
       "halvings of a step before the run stops",
       0,
       20,
       {},
       WILT_FIELD(solver.max_halvings)},
  };
}

#undef WILT_FIELD

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

const Setting& find_setting(std::string_view key) {
  Words keys;
  for (const Setting& setting : settings()) {
    if (setting.key == key) return setting;
    keys.push_back(setting.key);
  }
  fail(fmt::format("unknown setting '{}'{}; `wilt simulate --print-config` lists them all", key,
                   did_you_mean(key, keys)));
}

std::string allowed(const Setting& setting) {
  return fmt::format("{} must be between {} and {}{}", setting.key, setting.min, setting.max,
                     setting.unit.empty() ? "" : " " + setting.unit);
}

void check_range(const Setting& setting, double value) {
  if (!(value >= setting.min && value <= setting.max))
    fail(fmt::format("{}, not {}", allowed(setting), value));
}

void assign_word(const Setting& setting, std::string& field, const std::string& value) {
  if (setting.key == "species") {
    try {
      field = species(value).name;
    } catch (const Error& error) {
      fail(fmt::format("species: {}", error.what()));
    }
    return;
  }
  if (std::find(setting.words.begin(), setting.words.end(), value) == setting.words.end())
    fail(fmt::format("{} must be one of {}, not '{}'{}", setting.key, fmt::join(setting.words, ", "), value,
                     did_you_mean(value, setting.words)));
  field = value;
}

void assign_number(const Setting& setting, const Setting::Field& field, double value) {
  check_range(setting, value);
  if (auto* const* number = std::get_if<double*>(&field)) {
    **number = value;
  } else if (value != std::floor(value)) {
    fail(fmt::format("{} must be a whole number, not {}", setting.key, value));
  } else {
    *std::get<std::int64_t*>(field) = static_cast<std::int64_t>(value);
  }
}

bool is_number(const Setting::Field& field) {
  return std::holds_alternative<double*>(field) || std::holds_alternative<std::int64_t*>(field);
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix,
                 std::string_view source);

void apply_node(Config& config, const std::string& key, const toml::node& node, std::string_view source) {
  if (const toml::table* nested = node.as_table()) return apply_table(config, *nested, key + ".", source);
  try {
    const Setting& setting = find_setting(key);
    const Setting::Field field = setting.field(config);
    if (is_number(field) && node.is_number()) {
      assign_number(setting, field, *node.value<double>());
    } else if (bool* const* flag = std::get_if<bool*>(&field); flag && node.is_boolean()) {
      **flag = *node.value<bool>();
    } else if (std::string* const* word = std::get_if<std::string*>(&field); word && node.is_string()) {
      assign_word(setting, **word, *node.value<std::string>());
    } else {
      fail(fmt::format("{} must be {}", key,
                       is_number(field)                       ? "a number"
                       : std::holds_alternative<bool*>(field) ? "true or false"
                                                              : "a word in quotes"));
    }
  } catch (const Error& error) {
    fail(fmt::format("{}, line {}: {}", source, node.source().begin.line, error.what()));
  }
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix,
                 std::string_view source) {
  for (const auto& [key, node] : table) apply_node(config, prefix + std::string(key.str()), node, source);
}

toml::table parse(std::string_view toml, std::string_view source) {
  try {
    return toml::parse(toml);
  } catch (const toml::parse_error& error) {
    fail(fmt::format("{}, line {}: {}", source, error.source().begin.line, error.description()));
  }
}

// The shortest decimal form that reads back to the same number.
std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string value_text(const Setting& setting, Config& config) {
  const Setting::Field field = setting.field(config);
  if (auto* const* number = std::get_if<double*>(&field)) return number_text(**number);
  if (auto* const* integer = std::get_if<std::int64_t*>(&field)) return fmt::format("{}", **integer);
  if (auto* const* flag = std::get_if<bool*>(&field)) return **flag ? "true" : "false";
  return fmt::format("\"{}\"", *std::get<std::string*>(field));
}

std::string comment_of(const Setting& setting, const Setting::Field& field) {
  std::string text = setting.help;
  if (!setting.unit.empty()) text += fmt::format(" [{}]", setting.unit);
  if (is_number(field)) {
    text += fmt::format("; {} to {}", setting.min, setting.max);
  } else if (!setting.words.empty()) {
    text += fmt::format("; {}", fmt::join(setting.words, ", "));
  }
  return text;
}

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> table = make_settings();
  return table;
}

Config default_config(const Species& species) {
  Config config;
  const Physiology& p = species.physiology;
  config.species = species.name;
  config.mass.min = p.mass_min;
  config.mass.max = p.mass_max;
  config.water.loss_rate = p.dehydration_rate;
  config.water.dryness_scale = p.dryness_scale;
  config.external.range = p.force_range;
  config.shrinkage.amount = p.shrinkage;
  return config;
}

void set(Config& config, std::string_view key, std::string_view value) {
  const Setting& setting = find_setting(key);
  const Setting::Field field = setting.field(config);
  const std::string text(value);
  if (std::string* const* word = std::get_if<std::string*>(&field)) return assign_word(setting, **word, text);
  if (bool* const* flag = std::get_if<bool*>(&field)) {
    if (text != "true" && text != "false") fail(fmt::format("{} must be true or false, not '{}'", key, text));
    **flag = text == "true";
    return;
  }
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') fail(fmt::format("{}, not '{}'", allowed(setting), text));
  assign_number(setting, field, number);
}

void apply_toml(Config& config, std::string_view toml, std::string_view source) {
  apply_table(config, parse(toml, source), "", source);
}

std::string species_in_toml(std::string_view toml, std::string_view source) {
  return parse(toml, source)["species"].value_or(std::string());
}

std::string to_toml(const Config& config, bool commented) {
  Config copy = config;
  std::string text, section;
  for (const Setting& setting : settings()) {
    const std::size_t dot = setting.key.find('.');
    const std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    if (table != section) {
      text += fmt::format("\n[{}]\n", table);
      section = table;
    }
    const std::string name = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
    const std::string line = fmt::format("{} = {}", name, value_text(setting, copy));
    text +=
        commented ? fmt::format("{:<32}# {}\n", line, comment_of(setting, setting.field(copy))) : line + "\n";
  }
  return text;
}

std::string to_json(const Config& config) {
  Config copy = config;
  nlohmann::ordered_json json;
  for (const Setting& setting : settings())
    std::visit([&](const auto* value) { json[setting.key] = *value; }, setting.field(copy));
  return json.dump();
}

VenationOptions venation_options(const Config& config) {
  VenationOptions options;
  options.peaks.rule = config.veins.peaks == "window" ? PeakRule::window : PeakRule::prominence;
  options.peaks.window_vertices = static_cast<int>(config.veins.window_vertices);
  options.peaks.window_length = config.veins.window_length;
  options.peaks.min_prominence = config.veins.min_prominence;
  options.geodesics = config.veins.geodesics == "exact" ? GeodesicMethod::exact : GeodesicMethod::fast;
  options.full_embedding_up_to = static_cast<int>(config.veins.full_embedding_up_to);
  options.landmarks = static_cast<int>(config.veins.landmarks);
  options.secondary = config.veins.secondary;
  return options;
}

}  // namespace wilt
