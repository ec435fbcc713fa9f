// wilt species: what is built in.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "verbs.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

nlohmann::ordered_json to_json(const Species& s) {
  const Physiology& p = s.physiology;
  return {{"name", s.name},
          {"botanical", s.botanical},
          {"common", s.common},
          {"length_m", s.length},
          {"mass_min", p.mass_min},
          {"mass_max", p.mass_max},
          {"leaf_parameter", p.leaf_parameter},
          {"dehydration_rate", p.dehydration_rate},
          {"force_range", p.force_range},
          {"dryness_scale", p.dryness_scale},
          {"shrinkage", p.shrinkage}};
}

std::string table() {
  std::string text = fmt::format("{:<8} {:<22} {:<18} {:>7}  {:>11}  {:>7} {:>7} {:>5} {:>5}\n", "name",
                                 "botanical", "common", "length", "mass", "K", "w_loss", "K_r", "s");
  for (const std::string& name : species_names()) {
    const Species& s = species(name);
    const Physiology& p = s.physiology;
    text +=
        fmt::format("{:<8} {:<22} {:<18} {:>4.0f} mm  {:.2f} - {:.2f}  {:>7.4f} {:>7.3f} {:>5.1f} {:>5.1f}\n",
                    s.name, s.botanical, s.common, 1e3 * s.length, p.mass_min, p.mass_max, p.leaf_parameter,
                    p.dehydration_rate, p.force_range, p.shrinkage);
  }
  return text + fmt::format(
                    "\nmass: m_min - m_max of a cell; K: leaf parameter; w_loss: dehydration rate; K_r: "
                    "range of the "
                    "external\n"
                    "force (Table 1 of the paper); s: amount of differential shrinkage.\n"
                    "Next: wilt simulate {} -o {}.glb\n",
                    species_names().front(), species_names().front());
}

}  // namespace

void add_species(CLI::App& app, const GlobalOptions& options) {
  CLI::App* verb = app.add_subcommand("species",
                                      "What is built in, with parameters\n\n"
                                      "Examples:\n"
                                      "  wilt species\n"
                                      "  wilt species --json\n");
  verb->callback([&options] {
    if (!options.json) return print_data(table());
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const std::string& name : species_names()) all.push_back(to_json(species(name)));
    print_data(all.dump(2) + "\n");
  });
}

}  // namespace wilt::cli
