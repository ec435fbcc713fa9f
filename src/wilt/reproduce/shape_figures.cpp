// Figures 7 and 8: what swelling and external forces do to six species, and how it grows.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "wilt/leaf/species.hpp"
#include "wilt/render/contact_sheet.hpp"
#include "wilt/reproduce/figures.hpp"
#include "wilt/reproduce/measures.hpp"

namespace wilt::detail {
namespace {

constexpr double kVisibleWrinkle =
    0.002;                           // of the length: 0.2 mm on a leaf of 100 mm, about a blade's thickness
constexpr double kClearCurl = 20.0;  // degrees
constexpr double kMoreCurl = 10.0;   // degrees
constexpr double kSmallScale = 0.5;  // of a small picture

// A row of figure 7: the forces that act.
struct Forces {
  const char* name;
  const char* file;
  Overrides overrides;
};

const std::vector<Forces>& rows_of_figure_7() {
  static const std::vector<Forces> rows = {
      {"neither force", "none", {{"swelling.coefficient", "0"}, {"external.scale", "0"}}},
      {"swelling", "swelling", {{"external.scale", "0"}}},
      {"swelling, external", "both", {}}};
  return rows;
}

std::string list_of(const std::vector<double>& values, int digits) {
  std::vector<std::string> parts;
  for (std::size_t s = 0; s < values.size(); ++s)
    parts.push_back(fmt::format("{} {:.{}f}", species_names()[s], values[s], digits));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// The least value; not a number when one is not.
double least(const std::vector<double>& values) {
  double result = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (!(value >= result)) result = value;
    if (result != result) return result;
  }
  return result;
}

void add_claims_7(Figure& figure, const char* model, const std::vector<std::vector<FinalMetrics>>& metrics) {
  std::vector<double> wrinkle, curl;
  for (const auto& rows : metrics) {
    wrinkle.push_back(rows[1].wrinkle - rows[0].wrinkle);
    curl.push_back(rows[2].curl - rows[1].curl);
  }
  figure.claims.push_back({"fig7",
                           "swelling-wrinkles",
                           "Swelling wrinkles the leaves",
                           model,
                           "wrinkle with swelling minus without, least of six species",
                           least(wrinkle),
                           "L",
                           {Criterion::Kind::at_least, kVisibleWrinkle},
                           "by species: " + list_of(wrinkle, 4)});
  figure.claims.push_back({"fig7",
                           "external-curls",
                           "External forces curl the leaves",
                           model,
                           "curl with external forces minus without, least of six species",
                           least(curl),
                           "degrees",
                           {Criterion::Kind::at_least, kMoreCurl},
                           "by species: " + list_of(curl, 0)});
}

std::vector<double> iterations_of(const Experiment& experiment) {
  std::vector<double> iterations;
  for (const FrameMetrics& m : experiment.result.metrics) iterations.push_back(m.iteration);
  return iterations;
}

std::vector<double> metric_curve(const Experiment& experiment, double FrameMetrics::*metric, double factor) {
  std::vector<double> curve;
  for (const FrameMetrics& m : experiment.result.metrics) curve.push_back(factor * m.*metric);
  return curve;
}

void add_claims_8(Figure& figure, const char* model, const std::vector<const Experiment*>& runs) {
  std::vector<double> wrinkle, curl, last;
  for (const Experiment* run : runs) {
    const std::vector<double> n = iterations_of(*run);
    wrinkle.push_back(rank_correlation(n, metric_curve(*run, &FrameMetrics::wrinkle, 1.0)));
    curl.push_back(rank_correlation(n, metric_curve(*run, &FrameMetrics::curl, 1.0)));
    last.push_back(final_metrics(*run).curl);
  }
  const char* metric = "rank correlation with the iteration, least of six species";
  figure.claims.push_back({"fig8",
                           "wrinkle-grows",
                           "Wrinkles grow with the iterations",
                           model,
                           metric,
                           least(wrinkle),
                           "",
                           {Criterion::Kind::at_least, 0.9},
                           "by species: " + list_of(wrinkle, 2)});
  figure.claims.push_back({"fig8",
                           "curl-grows",
                           "Curl grows with the iterations",
                           model,
                           metric,
                           least(curl),
                           "",
                           {Criterion::Kind::at_least, 0.9},
                           "by species: " + list_of(curl, 2)});
  figure.claims.push_back({"fig8",
                           "clear-at-100",
                           "Withering is clear after 100 iterations",
                           model,
                           "curl at 100, least of six species",
                           least(last),
                           "degrees",
                           {Criterion::Kind::at_least, kClearCurl},
                           "by species: " + list_of(last, 0)});
}

Plot growth_plot(const char* model, const std::vector<const Experiment*>& runs) {
  Plot plot{fmt::format("fig8-growth-{}", model),
            {{fmt::format("Wrinkle ({})", model), "iteration", "wrinkle / length", {}},
             {fmt::format("Curl ({})", model), "iteration", "curl, degrees", {}}},
            2};
  for (const Experiment* run : runs) {
    const std::string& name = run->config.species;
    plot.panels[0].series.push_back(
        {name, iterations_of(*run), metric_curve(*run, &FrameMetrics::wrinkle, 1.0)});
    plot.panels[1].series.push_back(
        {name, iterations_of(*run), metric_curve(*run, &FrameMetrics::curl, 180.0 / std::numbers::pi)});
  }
  return plot;
}

}  // namespace

Figure figure_7(Workshop& workshop) {
  const int species_count = static_cast<int>(species_names().size());
  workshop.start("figure 7", 2 * 6 * species_count);
  Figure figure{"fig7",
                "Swelling wrinkles, external forces curl",
                "Without both forces the leaves stay as they are; swelling makes wrinkles pronounced; "
                "external forces on "
                "top make the curl pronounced.",
                {},
                {}};
  for (const char* model : kModels) {
    PictureGrid grid{fmt::format("Model {}, after 100 iterations; each species under one camera. All lose "
                                 "water, hence the colours. w: wrinkle in "
                                 "thousandths of the length; c: curl.",
                                 model),
                     species_names(),
                     {}};
    for (const Forces& row : rows_of_figure_7()) grid.rows.push_back({row.name, {}});
    std::vector<std::vector<FinalMetrics>> metrics;
    for (const std::string& name : species_names()) {
      std::vector<Shot> shots;
      metrics.emplace_back();
      for (const Forces& row : rows_of_figure_7()) {
        const Experiment& run = workshop.experiments().run(name, model, row.overrides);
        shots.push_back({&run, Experiments::kFrames - 1});
        metrics.back().push_back(final_metrics(run));
        workshop.done();
      }
      const std::vector<Image> images = workshop.pictures().row(shots);
      for (std::size_t k = 0; k < images.size(); ++k) {
        const Forces& row = rows_of_figure_7()[k];
        const FinalMetrics& m = metrics.back()[k];
        grid.rows[k].pictures.push_back(
            workshop.save(fmt::format("fig7-{}-{}-{}", model, name, row.file), images[k],
                          fmt::format("{} after 100 iterations, {}, model {}", name, row.name, model),
                          fmt::format("w {:.1f}, c {:.0f}°", 1e3 * m.wrinkle, m.curl)));
      }
      workshop.done(static_cast<int>(images.size()));
    }
    figure.blocks.emplace_back(std::move(grid));
    add_claims_7(figure, model, metrics);
  }
  return figure;
}

Figure figure_8(Workshop& workshop) {
  workshop.start("figure 8", 2 * static_cast<int>(species_names().size()));
  Figure figure{
      "fig8",
      "From fresh to withered",
      "Wrinkles and curl become more and more obvious as the iterations go on, and after 100 the leaf has "
      "withered realistically.",
      {},
      {}};
  for (const char* model : kModels) {
    PictureStrips strips{fmt::format("Model {}; each species under one camera.", model), {}, {}};
    std::vector<const Experiment*> runs;
    for (const std::string& name : species_names()) {
      const Experiment& run = workshop.experiments().run(name, model);
      runs.push_back(&run);
      std::vector<Shot> shots;
      for (int frame = 0; frame < static_cast<int>(run.result.frames.size()); ++frame)
        shots.push_back({&run, frame});
      const Image strip =
          contact_sheet(workshop.pictures().row(shots, kSmallScale), static_cast<int>(shots.size()));
      strips.rows.push_back(
          {name, workshop.save(fmt::format("fig8-{}-{}", model, name), strip,
                               fmt::format("{} from fresh to withered in {} pictures, model {}", name,
                                           shots.size(), model))});
      workshop.done();
    }
    for (const Frame& frame : runs.front()->result.frames)
      strips.columns.push_back(fmt::format("{}", frame.iteration));
    figure.blocks.emplace_back(std::move(strips));
    figure.blocks.emplace_back(workshop.draw(
        growth_plot(model, runs), fmt::format("Wrinkle and curl over the iterations, model {}.", model),
        "Wrinkle and curl of six species over the iterations"));
    add_claims_8(figure, model, runs);
  }
  return figure;
}

}  // namespace wilt::detail
