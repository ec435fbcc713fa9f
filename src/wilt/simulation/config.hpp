// Every setting of a simulation, in one place: key, unit, default, range.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wilt/leaf/species.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// What a setting becomes during a run.
struct Change {
  std::int64_t iteration = 0;  ///< the steps after it have the new value
  std::string key, value;      ///< as `set` takes them
};

/// The resolved configuration of a run. Working units: the leaf's length is 8, masses and forces as in the
/// paper.
///
/// The meaning, unit and range of each member stand in the table in settings.cpp, which `wilt
/// simulate --print-config` prints.
struct Config {
  std::string model = "cell";
  std::string species = "generic";
  std::int64_t vertices = 0;
  std::int64_t seed = 1;
  std::int64_t iterations = 100;
  std::int64_t frames = 26;
  double dt = 0.1;
  std::string pin = "ring";

  struct {
    double seconds = 4.0, hours = 48.0;
  } clip;
  struct {
    std::string peaks = "prominence", geodesics = "fast";
    std::int64_t window_vertices = 8, full_embedding_up_to = 1000, landmarks = 60;
    double window_length = 0.06, min_prominence = 0.02;
    bool secondary = true;
    bool from_photo = true;
  } veins;
  struct {
    double min = 0.8, max = 1.5, tau = 1.0, water_fraction = 0.8;
  } mass;
  struct {
    double temperature_c = 20.0, humidity = 0.5, loss_rate = 0.02, diffusion = 0.1, dryness_scale = 0.3;
    std::vector<double> dry_region;
    double dry_factor = 3.0;
  } water;
  struct {
    double cell_constant = 2e-4, poisson_ratio = 0.499;
  } pressure;
  struct {
    double stiffness = 4.0, damping = 0.1, vein_factor = 5.0;
  } springs;
  struct {
    double coefficient = 1.0;
  } swelling;
  struct {
    std::string variant = "a";
    std::vector<double> forces;
    double range = 1.0, growth = 0.3, scale = 1.0;
  } external;
  struct {
    double stiffness = 6e-4, wrinkle_length = 0.2, turgor_loss = 0.5, vein_factor = 5.0, grain = 4.0,
           rim_factor = 20.0;
  } bending;
  struct {
    double amount = 1.0, vein_gap = 1.0, margin = 1.0, noise = 0.75, fold = 0.5, crinkle = 0.5;
  } shrinkage;
  struct {
    double roll = 60.0, roll_reach = 0.06, tip = 12.0, tip_reach = 0.2, panel = 80.0, variation = 0.5;
  } curvature;
  struct {
    double threshold = 0.35, stiffness = 40.0, area = 0.4;
  } strain_limit;
  struct {
    double strength = 0.004, petiole_stiffness = 15.0, petiole_turgor_loss = 0.9;
  } gravity;
  struct {
    std::int64_t size = 1024;
  } texture;
  struct {
    std::int64_t vertices = 120;
  } reference;
  struct {
    double tolerance = 1e-8;
    std::int64_t max_newton = 30, max_halvings = 8;
  } solver;

  std::vector<Change> changes;  ///< by iteration, then key; add_change() puts them in
};

/// The model's defaults with a species' Table 1 and calibrations.
Config default_config(const Species& species);

/// One row of the table of settings.
struct Setting {
  using Field = std::variant<double*, std::int64_t*, bool*, std::string*, std::vector<double>*>;
  std::string key;   ///< dotted name: "water.temperature_c"
  std::string unit;  ///< "" when it is a pure number
  std::string help;
  double min = 0.0, max = 0.0;     ///< numbers: the allowed range, inclusive, of each in a list
  std::vector<std::string> words;  ///< words: what is allowed
  Field (*field)(Config&);
  bool during_run = false;  ///< whether it may change in a run
  int multiple = 1;         ///< lists: what the count of numbers is a multiple of,
  int fewest = 0;           ///< and its least unless the list is empty

  bool has_range() const { return min < max; }  ///< numbers and lists
};
const std::vector<Setting>& settings();

/// Sets one key from text, as `--set key=value` gives it; a list as numbers with commas between, or nothing.
/// Throws Error{configuration}: an unknown key with the nearest one, a value of the wrong kind or out of
/// range with what is allowed.
void set(Config& config, std::string_view key, std::string_view value);

/// Has a setting change in the run: the steps after `iteration`, 0 to 1e6, have the new value. It takes the
/// place of another change of the same setting after the same iteration. Same errors as `set`, and for
/// settings that may not change (Setting::during_run); `config` is then as it was.
void add_change(Config& config, std::int64_t iteration, std::string_view key, std::string_view value);

/// The settings of the step after `iteration`: all changes up to it made.
Config config_after(const Config& config, std::int64_t iteration);

/// Throws Error{configuration} with source and line for keys with more parts than any has: the library that
/// reads TOML calls itself for each. To be called before it.
void check_toml_keys(std::string_view toml, std::string_view source);

/// Applies a TOML document; `source` names it in messages. Sections [[change]] hold `iteration` and the
/// settings that change after it. Same errors as `set` and `add_change`.
void apply_toml(Config& config, std::string_view toml, std::string_view source);

struct Assignment {
  std::string key, value;  ///< as `set` takes them
};

/// The configuration of a run: defaults of a species, then the TOML document, then the assignments; the later
/// wins. The species is `preset` unless one of them names another. Same errors as `set`.
Config resolve_config(const std::string& preset, std::string_view toml, std::string_view source,
                      const std::vector<Assignment>& assignments);

/// As TOML that apply_toml takes back, with unit and range in comments when `commented`.
std::string to_toml(const Config& config, bool commented);

/// The same with only the species and what differs from its defaults.
std::string unusual_toml(const Config& config);

/// As a JSON object {"key": value, ...} in the order of the table, then, if there are any, the changes:
/// "change": [{"iteration": n, "key": value, ...}, ...].
std::string to_json(const Config& config);

VenationOptions venation_options(const Config& config);

}  // namespace wilt
