// Figures 9 to 11: the forces over the iterations, and what the rate of water loss does. All on the willow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "wilt/leaf/species.hpp"
#include "wilt/reproduce/figures.hpp"
#include "wilt/reproduce/measures.hpp"
#include "wilt/simulation/regions.hpp"

namespace wilt::detail {
namespace {

constexpr const char* kLeaf = "willow";
constexpr std::array<Region, 4> kRegions = {Region::tip, Region::vein, Region::margin, Region::mesophyll};
constexpr std::array<double, 5> kRates = {0.0, 0.5, 1.0, 1.5, 2.0};  // of the table's w_loss
constexpr double kWaveShare = 0.02;  // of the curve's range: what counts as a wave
constexpr int kWindow = 10;          // iterations of a running mean

std::vector<double> counted(std::size_t count) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

double rising(const std::vector<double>& curve) {
  return rank_correlation(counted(curve.size()), curve);
}

// The mean over the last window against the largest mean over any.
double late_share(const std::vector<double>& curve) {
  double largest = 0.0, last = 0.0;
  for (std::size_t begin = 0; begin + kWindow <= curve.size(); ++begin) {
    last = std::accumulate(curve.begin() + begin, curve.begin() + begin + kWindow, 0.0) / kWindow;
    largest = std::max(largest, last);
  }
  return largest > 0.0 ? last / largest : 1.0;
}

struct ForceKind {
  const char* name;
  double ForceRow::*member;
};
constexpr std::array<ForceKind, 4> kForces = {{{"external", &ForceRow::external},
                                               {"elastic", &ForceRow::elastic},
                                               {"swelling", &ForceRow::swelling},
                                               {"damping", &ForceRow::damping}}};

Plot forces_plot(const Experiment& run, const char* model) {
  Plot plot{fmt::format("fig9-forces-{}", model), {}, 2};
  for (const ForceKind& force : kForces) {
    Panel panel{force.name, "iteration", "mean force", {}};
    for (const Region region : kRegions) {
      const std::vector<double> curve = force_curve(run, region, force.member);
      panel.series.push_back({region_name(region), counted(curve.size()), curve});
    }
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

double rise(const std::vector<double>& curve) {
  return curve.back() - curve.front();
}

void add_external_claims(Figure& figure, const char* model, const Experiment& run) {
  const std::vector<double> tip = force_curve(run, Region::tip, &ForceRow::external);
  figure.claims.push_back({"fig9",
                           "external-rises",
                           "The external force rises at the tips",
                           model,
                           "rank correlation with the iteration",
                           rising(tip),
                           "",
                           {Criterion::Kind::at_least, 0.99},
                           fmt::format("from {:.3g} to {:.3g}", tip.front(), tip.back())});
  double elsewhere = 0.0;
  for (const Region region : {Region::vein, Region::margin, Region::mesophyll})
    elsewhere = std::max(elsewhere, rise(force_curve(run, region, &ForceRow::external)));
  figure.claims.push_back({"fig9",
                           "external-local",
                           "Away from the tips the external force hardly rises",
                           model,
                           "largest rise elsewhere / rise at the tips",
                           elsewhere / rise(tip),
                           "",
                           {Criterion::Kind::at_most, 0.25},
                           fmt::format("K_r = {:g}", run.config.external.range)});
}

void add_internal_claims(Figure& figure, const char* model, const Experiment& run) {
  int most_waves = 0;
  double least_rise = 1.0;
  std::string waves;
  for (const Region region : kRegions) {
    const int count = count_waves(force_curve(run, region, &ForceRow::elastic), kWaveShare);
    most_waves = std::max(most_waves, count);
    waves += fmt::format("{}{} {}", waves.empty() ? "" : ", ", region_name(region), count);
    least_rise = std::min(least_rise, rising(force_curve(run, region, &ForceRow::swelling)));
  }
  figure.claims.push_back(
      {"fig9",
       "elastic-waves",
       "The elastic force rises in waves",
       model,
       fmt::format("waves of at least {:.0f} % of the range, region with most", 100 * kWaveShare),
       most_waves,
       "",
       {Criterion::Kind::at_least, 2},
       "by region: " + waves});
  figure.claims.push_back({"fig9",
                           "swelling-rises",
                           "The swelling force rises steadily",
                           model,
                           "rank correlation with the iteration, least of four regions",
                           least_rise,
                           "",
                           {Criterion::Kind::at_least, 0.99},
                           ""});
  const double late = late_share(force_curve(run, Region::tip, &ForceRow::damping));
  figure.claims.push_back({"fig9",
                           "damping-falls",
                           "Late, damping falls at the tips",
                           model,
                           "mean of the last ten iterations / largest mean of ten",
                           late,
                           "",
                           {Criterion::Kind::at_most, 0.9},
                           "at the tips"});
  figure.claims.push_back({"fig9",
                           "leaf-accelerates",
                           "Elsewhere damping, that is speed, rises",
                           model,
                           "rank correlation with the iteration, mesophyll",
                           rising(force_curve(run, Region::mesophyll, &ForceRow::damping)),
                           "",
                           {Criterion::Kind::at_least, 0.5},
                           ""});
}

// The runs of figures 10 and 11: no external forces, w_loss from nothing to twice the table's.
std::vector<const Experiment*> dried(Workshop& workshop, const char* model) {
  std::vector<const Experiment*> runs;
  const double table = species(kLeaf).physiology.dehydration_rate;
  for (const double rate : kRates) {
    runs.push_back(&workshop.experiments().run(
        kLeaf, model, {{"external.scale", "0"}, {"water.loss_rate", setting_text(rate * table)}}));
    workshop.done();
  }
  return runs;
}

std::string rate_text(const Experiment& run) {
  return fmt::format("{:.4g}", run.config.water.loss_rate);
}

}  // namespace

Figure figure_9(Workshop& workshop) {
  workshop.start("figure 9", 2);
  Figure figure{
      "fig9",
      "Forces on the cells of a willow leaf",
      "The external force rises at the tips and hardly elsewhere; the elastic force rises in waves; the "
      "swelling force rises steadily; damping shows that the leaf speeds up, but late the tips slow down.",
      {},
      {}};
  for (const char* model : kModels) {
    const Experiment& run = workshop.experiments().run(kLeaf, model);
    figure.blocks.emplace_back(workshop.draw(
        forces_plot(run, model),
        fmt::format("Mean magnitude over the cells of a region, working units, model {}.", model),
        fmt::format(
            "Four panels: external, elastic, swelling and damping force over the iterations, model {}",
            model)));
    add_external_claims(figure, model, run);
    add_internal_claims(figure, model, run);
    workshop.done();
  }
  return figure;
}

Figure figure_10(Workshop& workshop) {
  workshop.start("figure 10", 11);
  Figure figure{
      "fig10",
      "Swelling force and the rate of water loss",
      "A mesophyll cell that loses no water has no swelling force; the larger the rate, the faster the force "
      "grows.",
      {},
      {}};
  Plot plot{"fig10-swelling", {}, 2};
  for (const char* model : kModels) {
    const std::vector<const Experiment*> runs = dried(workshop, model);
    Panel panel{model, "iteration", "swelling force", {}};
    double at_zero = 0.0, least_ratio = std::numeric_limits<double>::infinity(), least_rise = 1.0;
    std::vector<double> last;
    for (const Experiment* run : runs) {
      const std::vector<double> curve = force_curve(*run, Region::mesophyll, &ForceRow::swelling);
      panel.series.push_back({"w_{loss} = " + rate_text(*run), counted(curve.size()), curve});
      if (run == runs.front()) {
        at_zero = *std::max_element(curve.begin(), curve.end());
      } else {
        least_rise = std::min(least_rise, rising(curve));
        if (last.size() > 1) least_ratio = std::min(least_ratio, curve.back() / last.back());
      }
      last.push_back(curve.back());
    }
    plot.panels.push_back(std::move(panel));
    figure.claims.push_back({"fig10",
                             "zero-at-zero",
                             "Without water loss there is no swelling force",
                             model,
                             "largest force of any iteration at w_loss 0",
                             at_zero,
                             "",
                             {Criterion::Kind::exactly, 0},
                             ""});
    figure.claims.push_back({"fig10",
                             "grows-with-rate",
                             "The swelling force grows with w_loss",
                             model,
                             "force at the end over that at the next lower rate, least",
                             least_ratio,
                             "",
                             {Criterion::Kind::at_least, 1.05},
                             fmt::format("{:.3g} at the end", fmt::join(last, ", "))});
    figure.claims.push_back({"fig10",
                             "grows-with-time",
                             "With water loss the swelling force keeps growing",
                             model,
                             "rank correlation with the iteration, least of the rates",
                             least_rise,
                             "",
                             {Criterion::Kind::at_least, 0.99},
                             ""});
  }
  figure.blocks = {
      Paragraph{"The mean over the mesophyll cells of the willow; external forces are off, so that only the "
                "loss of water acts."},
      workshop.draw(plot, "Mean swelling force on a mesophyll cell, working units.",
                    "Swelling force over the iterations for five rates of water loss, a panel per model")};
  workshop.done();
  return figure;
}

Figure figure_11(Workshop& workshop) {
  workshop.start("figure 11", 20);
  Figure figure{
      "fig11",
      "Wrinkles and the rate of water loss",
      "Without water loss there are no wrinkles; the larger the rate, the more pronounced they are.",
      {},
      {}};
  PictureGrid grid{
      "The willow of figure 10 after 100 iterations; each row under one camera. w: wrinkle in thousandths of "
      "the length.",
      {},
      {}};
  for (const char* model : kModels) {
    const std::vector<const Experiment*> runs = dried(workshop, model);
    std::vector<Shot> shots;
    std::vector<double> rates, wrinkle;
    for (const Experiment* run : runs) {
      shots.push_back({run, Experiments::kFrames - 1});
      rates.push_back(run->config.water.loss_rate);
      wrinkle.push_back(final_metrics(*run).wrinkle);
    }
    const std::vector<Image> images = workshop.pictures().row(shots);
    grid.rows.push_back({model, {}});
    for (std::size_t k = 0; k < images.size(); ++k)
      grid.rows.back().pictures.push_back(
          workshop.save(fmt::format("fig11-{}-{}", model, k), images[k],
                        fmt::format("Willow leaf, w_loss {}, model {}", rate_text(*runs[k]), model),
                        fmt::format("w {:.2f}", 1e3 * wrinkle[k])));
    workshop.done(static_cast<int>(images.size()));
    grid.columns.clear();
    for (const Experiment* run : runs) grid.columns.push_back("w_loss " + rate_text(*run));
    const double rest = runs.front()->result.metrics.front().wrinkle;
    figure.claims.push_back({"fig11",
                             "none-at-zero",
                             "Without water loss there are no wrinkles",
                             model,
                             "wrinkle at w_loss 0 minus wrinkle at rest",
                             wrinkle.front() - rest,
                             "L",
                             {Criterion::Kind::at_most, 0.0005},
                             fmt::format("{:.5f} at rest", rest)});
    figure.claims.push_back({"fig11",
                             "grow-with-rate",
                             "Wrinkles grow with w_loss",
                             model,
                             "rank correlation of wrinkle and rate",
                             rank_correlation(rates, wrinkle),
                             "",
                             {Criterion::Kind::at_least, 0.9},
                             fmt::format("{:.4f}", fmt::join(wrinkle, ", "))});
    figure.claims.push_back({"fig11",
                             "pronounced",
                             "At the largest rate they are pronounced",
                             model,
                             "wrinkle at the largest rate minus at 0",
                             wrinkle.back() - wrinkle.front(),
                             "L",
                             {Criterion::Kind::at_least, 0.002},
                             ""});
  }
  figure.blocks.emplace_back(std::move(grid));
  return figure;
}

}  // namespace wilt::detail
