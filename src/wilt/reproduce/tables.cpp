// Tables 1 and 2: what the paper prints, typed in from its text, against what wilt holds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/leaf/species.hpp"
#include "wilt/reproduce/figures.hpp"
#include "wilt/simulation/external_force.hpp"

namespace wilt::detail {
namespace {

constexpr int kSpecies = 6, kTips = 7, kVariants = 6;

// A row of Table 1: the printed values and where wilt keeps them.
struct Row {
  const char* name;
  std::array<double, kSpecies> printed;  // maple, poplar, tilia, ivy, willow, grape
  double (*held)(const Config& config, const Species& species);
};

// c can be read for maple only; the others are taken to be the same.
const std::array<Row, 14> kTable1 = {{
    {"m_min", {.70, .75, .85, .80, .75, .80}, [](const Config& c, const Species&) { return c.mass.min; }},
    {"m_max",
     {1.50, 1.55, 1.65, 1.00, 1.55, 1.50},
     [](const Config& c, const Species&) { return c.mass.max; }},
    {"diffusion λ",
     {.1, .1, .1, .1, .1, .1},
     [](const Config& c, const Species&) { return c.water.diffusion; }},
    {"temperature T, °C",
     {20, 20, 20, 20, 20, 20},
     [](const Config& c, const Species&) { return c.water.temperature_c; }},
    {"humidity H",
     {.5, .5, .5, .5, .5, .5},
     [](const Config& c, const Species&) { return c.water.humidity; }},
    {"leaf parameter K",
     {2e-3, 4e-3, 2e-3, 4e-3, 5e-3, 4e-3},
     [](const Config&, const Species& s) { return s.physiology.leaf_parameter; }},
    {"dehydration rate w_loss",
     {.010, .020, .010, .020, .025, .020},
     [](const Config& c, const Species&) { return c.water.loss_rate; }},
    {"springs k_s", {4, 4, 4, 4, 4, 4}, [](const Config& c, const Species&) { return c.springs.stiffness; }},
    {"swelling k_p",
     {1, 1, 1, 1, 1, 1},
     [](const Config& c, const Species&) { return c.swelling.coefficient; }},
    {"cell constant c",
     {2e-4, 2e-4, 2e-4, 2e-4, 2e-4, 2e-4},
     [](const Config& c, const Species&) { return c.pressure.cell_constant; }},
    {"Poisson's ratio μ",
     {.499, .499, .499, .499, .499, .499},
     [](const Config& c, const Species&) { return c.pressure.poisson_ratio; }},
    {"damping k_d",
     {.1, .1, .1, .1, .1, .1},
     [](const Config& c, const Species&) { return c.springs.damping; }},
    {"external force K_r",
     {1.0, 1.0, .5, 1.0, .8, 1.0},
     [](const Config& c, const Species&) { return c.external.range; }},
    {"time step Δt", {.1, .1, .1, .1, .1, .1}, [](const Config& c, const Species&) { return c.dt; }},
}};
constexpr int kTemperature = 3, kHumidity = 4, kLeafParameter = 5, kLossRate = 6;

using Force = std::array<double, 3>;
using Variant = std::array<Force, kTips>;

// Table 2, column by column.
constexpr std::array<Variant, kVariants> kTable2 = {{
    {{{.00, .00, .04},
      {.00, .00, .04},
      {.01, .01, .04},
      {.03, -.03, .03},
      {-.02, .01, .04},
      {.00, .00, .04},
      {.00, .00, .04}}},
    {{{.00, .00, .04},
      {.00, .00, .04},
      {.01, .01, .04},
      {.00, -.03, -.03},
      {-.02, .01, .04},
      {.00, .00, .04},
      {.00, .00, .04}}},
    {{{-.01, -.01, .04},
      {.00, .00, .04},
      {.01, .01, .04},
      {.03, -.03, .03},
      {-.03, -.03, .06},
      {.00, .00, .04},
      {.00, .00, .04}}},
    {{{.00, .00, .04},
      {.04, .04, .04},
      {-.01, -.01, .02},
      {.03, -.03, .03},
      {-.02, .01, .04},
      {-.04, .00, .06},
      {.00, .00, .04}}},
    {{{.00, .00, .04},
      {.00, .04, .04},
      {.01, .01, .04},
      {-.03, -.03, .03},
      {-.02, .04, .04},
      {.00, .00, .04},
      {.00, .00, .04}}},
    {{{.00, .00, .04},
      {.00, .04, .04},
      {.01, .01, .04},
      {-.03, -.03, .03},
      {-.02, -.03, .06},
      {.00, .00, .04},
      {.00, .00, .04}}},
}};

// The printed value with a mark; what wilt holds, model by model, where it differs.
std::string cell_text(double printed, const std::vector<double>& held) {
  if (std::all_of(held.begin(), held.end(), [&](double value) { return value == printed; }))
    return fmt::format("{:.4g} ✓", printed);
  return fmt::format("{:.4g} ✗ wilt: {:.4g}", printed, fmt::join(held, ", "));
}

// The printed w_loss over the printed T H K, of the species where it is farthest from 1. Rounded: 0.010 / (20
// x 0.5 x 0.002) is a half but for the last bit.
double farthest_rate() {
  double farthest = 1.0;
  for (int s = 0; s < kSpecies; ++s) {
    const double product =
        kTable1[kTemperature].printed[s] * kTable1[kHumidity].printed[s] * kTable1[kLeafParameter].printed[s];
    const double ratio = std::round(1e9 * kTable1[kLossRate].printed[s] / product) / 1e9;
    if (std::abs(ratio - 1.0) > std::abs(farthest - 1.0)) farthest = ratio;
  }
  return farthest;
}

}  // namespace

Figure table_1(Workshop& workshop) {
  workshop.start("table 1", 1);
  Figure figure{"table1",
                "Parameters of the species",
                "The paper lists the parameters of six species, and defines the dehydration rate as "
                "temperature times humidity times the leaf's parameter, w_loss = T H K.",
                {},
                {}};
  TableBlock table{"As printed; ✓: wilt holds the same under both models.", {""}, {}};
  table.header.insert(table.header.end(), species_names().begin(), species_names().end());
  std::array<int, kModels.size()> differ{};
  for (const Row& row : kTable1) {
    table.rows.push_back({row.name});
    for (int s = 0; s < kSpecies; ++s) {
      const std::string& name = species_names()[s];
      std::vector<double> held;
      for (std::size_t m = 0; m < kModels.size(); ++m) {
        held.push_back(row.held(workshop.experiments().config(name, kModels[m]), species(name)));
        differ[m] += row.printed[s] == held.back() ? 0 : 1;
      }
      table.rows.back().push_back(cell_text(row.printed[s], held));
    }
  }
  figure.blocks.emplace_back(std::move(table));
  for (std::size_t m = 0; m < kModels.size(); ++m) {
    figure.claims.push_back({"table1",
                             "presets",
                             "The presets hold Table 1 as printed",
                             kModels[m],
                             "entries that differ",
                             differ[m],
                             "",
                             {Criterion::Kind::exactly, 0},
                             fmt::format("{} entries compared", kTable1.size() * kSpecies)});
    figure.claims.push_back({"table1",
                             "rate-is-thk",
                             "The printed w_loss is T H K",
                             kModels[m],
                             "printed w_loss / (T H K), the species farthest from 1",
                             farthest_rate(),
                             "",
                             {Criterion::Kind::exactly, 1},
                             "wilt takes the table's rate at 20 °C and 50 %"});
  }
  workshop.done();
  return figure;
}

Figure table_2(Workshop& workshop) {
  workshop.start("table 2", 1);
  Figure figure{"table2",
                "External forces at the start",
                "The paper lists the first external force at the seven tips of a leaf for six variants.",
                {},
                {}};
  TableBlock table{"As printed, for the tips r1 to r7; ✓: wilt holds the same (under both models).",
                   {"", "(a)", "(b)", "(c)", "(d)", "(e)", "(f)"},
                   {}};
  int differ = 0;
  for (int r = 0; r < kTips; ++r) {
    table.rows.push_back({fmt::format("r{}", r + 1)});
    for (int v = 0; v < kVariants; ++v) {
      const Points3 held = initial_tip_forces(kTips, std::string(1, static_cast<char>('a' + v)));
      const Force& printed = kTable2[v][r];
      const bool same = held(r, 0) == printed[0] && held(r, 1) == printed[1] && held(r, 2) == printed[2];
      differ += same ? 0 : 1;
      std::string text =
          fmt::format("{:g}, {:g}, {:g} {}", printed[0], printed[1], printed[2], same ? "✓" : "✗");
      if (!same) text += fmt::format(" wilt: {:g}, {:g}, {:g}", held(r, 0), held(r, 1), held(r, 2));
      table.rows.back().push_back(text);
    }
  }
  figure.blocks.emplace_back(std::move(table));
  for (const char* model : kModels)
    figure.claims.push_back({"table2",
                             "forces",
                             "wilt starts from Table 2 as printed",
                             model,
                             "forces that differ",
                             differ,
                             "",
                             {Criterion::Kind::exactly, 0},
                             fmt::format("{} forces compared", kTips * kVariants)});
  workshop.done();
  return figure;
}

}  // namespace wilt::detail
