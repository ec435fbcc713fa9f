// Figures 12, 13 and 15: what the external forces do; the comparison that waits for other models.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "wilt/reproduce/figures.hpp"
#include "wilt/reproduce/measures.hpp"

namespace wilt::detail {
namespace {

constexpr const char* kLeaf = "maple";  // the one with seven lobes
constexpr std::array<const char*, 6> kVariants = {"a", "b", "c", "d", "e", "f"};
constexpr std::array<double, 5> kRanges = {0.0, 0.5, 1.0, 1.5, 2.0};  // K_r

double rms_apart(const Experiment& a, const Experiment& b) {
  const Points3 difference = in_petiole_frame(a.subject, a.result.frames.back()) -
                             in_petiole_frame(b.subject, b.result.frames.back());
  return std::sqrt(difference.rowwise().squaredNorm().mean());
}

// The share of the blade that the external forces moved at least half as far as the tips; `without` is the
// same leaf without them.
double reach(const Experiment& run, const Experiment& without) {
  const Subject& subject = run.subject;
  const Eigen::VectorXd moved = (in_petiole_frame(subject, run.result.frames.back()) -
                                 in_petiole_frame(subject, without.result.frames.back()))
                                    .rowwise()
                                    .norm();
  const double half = 0.5 * region_mean(subject, moved, Region::tip);
  return area_share(subject, [&](VertexId v) { return moved[v] >= half; });
}

std::vector<Picture> pictures_of(Workshop& workshop, const std::vector<const Experiment*>& runs,
                                 const std::string& name, const std::string& alt) {
  std::vector<Shot> shots;
  for (const Experiment* run : runs) shots.push_back({run, Experiments::kFrames - 1});
  const std::vector<Image> images = workshop.pictures().row(shots);
  std::vector<Picture> pictures;
  for (std::size_t k = 0; k < images.size(); ++k)
    pictures.push_back(workshop.save(fmt::format("{}-{}", name, k + 1), images[k],
                                     fmt::format("{} {}", alt, k + 1),
                                     fmt::format("curl {:.0f}°", final_metrics(*runs[k]).curl)));
  workshop.done(static_cast<int>(images.size()));
  return pictures;
}

// How the leaf answers to K_r.
struct RangeSweep {
  std::vector<double> curl, tip, share;
};

RangeSweep sweep(const std::vector<const Experiment*>& runs, const Experiment& without) {
  RangeSweep result;
  for (const Experiment* run : runs) {
    result.curl.push_back(final_metrics(*run).curl);
    result.tip.push_back(tip_rotation_in_lobe(run->subject, run->result.frames.back()));
    result.share.push_back(reach(*run, without));
  }
  return result;
}

// The values, and the correlation without K_r = 0, where the force is the same all over the leaf.
std::string sweep_text(const char* what, const std::vector<double>& values, int digits) {
  const double local =
      rank_correlation({kRanges.begin() + 1, kRanges.end()}, {values.begin() + 1, values.end()});
  return fmt::format("{} {:.{}f}; {:.2g} without K_r = 0", what, fmt::join(values, ", "), digits, local);
}

void add_claims_13(Figure& figure, const char* model, const RangeSweep& found) {
  const std::vector<double> ranges(kRanges.begin(), kRanges.end());
  const char* metric = "rank correlation with K_r";
  figure.claims.push_back(
      {"fig13",
       "tip-curl",
       "The larger K_r, the more the tip curls against its own lobe",
       model,
       metric,
       rank_correlation(ranges, found.tip),
       "",
       {Criterion::Kind::at_least, 0.9},
       sweep_text("rotation of the tip against the tissue behind it, degrees:", found.tip, 1)});
  figure.claims.push_back({"fig13",
                           "curl",
                           "The larger K_r, the more the tip turns against the petiole",
                           model,
                           metric,
                           rank_correlation(ranges, found.curl),
                           "",
                           {Criterion::Kind::at_least, 0.9},
                           sweep_text("curl, degrees:", found.curl, 1)});
  figure.claims.push_back(
      {"fig13",
       "range",
       "The larger K_r, the smaller the part that curls",
       model,
       metric,
       rank_correlation(ranges, found.share),
       "",
       {Criterion::Kind::at_most, -0.9},
       sweep_text("share of the blade that the forces moved half as far as the tips:", found.share, 3)});
}

void add_to_plot(Plot& plot, const char* model, const RangeSweep& found) {
  const std::vector<double> ranges(kRanges.begin(), kRanges.end());
  const auto style = Series::Style::line_and_points;
  plot.panels[0].series.push_back({model, ranges, found.tip, style});
  plot.panels[1].series.push_back({model, ranges, found.curl, style});
  plot.panels[2].series.push_back({model, ranges, found.share, style});
}

}  // namespace

Figure figure_12(Workshop& workshop) {
  workshop.start("figure 12", 24);
  Figure figure{"fig12",
                "Six variants of the external forces",
                "Other external forces at the start (table 2) curl the same leaf in visibly other ways.",
                {},
                {}};
  PictureGrid grid{"The maple after 100 iterations under the columns of table 2; each row under one camera.",
                   {"(a)", "(b)", "(c)", "(d)", "(e)", "(f)"},
                   {}};
  for (const char* model : kModels) {
    std::vector<const Experiment*> runs;
    for (const char* variant : kVariants) {
      runs.push_back(&workshop.experiments().run(kLeaf, model, {{"external.variant", variant}}));
      workshop.done();
    }
    grid.rows.push_back({model, pictures_of(workshop, runs, fmt::format("fig12-{}", model),
                                            "Maple under the forces of column")});
    TableBlock table{fmt::format("RMS distance between the leaves in lengths, model {}.", model), {""}, {}};
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      table.header.push_back(fmt::format("({})", kVariants[i]));
      table.rows.push_back({fmt::format("({})", kVariants[i])});
      for (std::size_t j = 0; j < runs.size(); ++j) {
        const double apart = rms_apart(*runs[i], *runs[j]);
        if (j < i) least = std::min(least, apart), most = std::max(most, apart);
        table.rows.back().push_back(j == i ? "" : fmt::format("{:.3f}", apart));
      }
    }
    figure.claims.push_back({"fig12",
                             "differ",
                             "The six variants differ",
                             model,
                             "RMS distance of the two most alike",
                             least,
                             "L",
                             {Criterion::Kind::at_least, 0.01},
                             fmt::format("{:.3f} L between the two least alike", most)});
    figure.blocks.emplace_back(std::move(table));
  }
  figure.blocks.insert(figure.blocks.begin(), std::move(grid));
  return figure;
}

Figure figure_13(Workshop& workshop) {
  workshop.start("figure 13", 22);
  Figure figure{
      "fig13",
      "Range of the external forces",
      "The larger K_r, the stronger the curl at the tips and the smaller the part of the leaf that curls.",
      {},
      {}};
  PictureGrid grid{"The maple after 100 iterations; each row under one camera.", {}, {}};
  for (const double range : kRanges) grid.columns.push_back(fmt::format("K_r {:g}", range));
  Plot plot{"fig13-range",
            {{"Tip against its lobe", "K_r", "rotation, degrees", {}},
             {"Tip against the petiole", "K_r", "curl, degrees", {}},
             {"Part that curls", "K_r", "share of the blade", {}}},
            3,
            400,
            280};
  for (const char* model : kModels) {
    std::vector<const Experiment*> runs;
    for (const double range : kRanges) {
      runs.push_back(&workshop.experiments().run(kLeaf, model, {{"external.range", setting_text(range)}}));
      workshop.done();
    }
    grid.rows.push_back(
        {model, pictures_of(workshop, runs, fmt::format("fig13-{}", model), "Maple, value of K_r")});
    const RangeSweep found = sweep(runs, workshop.experiments().run(kLeaf, model, {{"external.scale", "0"}}));
    workshop.done();
    add_to_plot(plot, model, found);
    add_claims_13(figure, model, found);
  }
  figure.blocks = {
      std::move(grid),
      workshop.draw(
          plot,
          "Left: rotation of the tip against the tissue 0.12 to 0.30 of the length behind it. "
          "Right: share of the blade that the external forces moved at least half as far as the tips.",
          "Rotation of the tips, curl, and the part that moves over K_r")};
  return figure;
}

Figure figure_15(Workshop& workshop) {
  workshop.start("figure 15", 1);
  Figure figure{"fig15",
                "Against a vein-driven model",
                "The paper sets its leaves beside those of Wei et al. (2015), whose blade follows driven "
                "veins, and finds "
                "its own more wrinkled and more natural.",
                {Paragraph{"Not run: it comes with later models."}},
                {}};
  for (const char* model : kModels)
    figure.claims.push_back({"fig15",
                             "more-wrinkled",
                             "More wrinkled than the vein-driven model",
                             model,
                             "wrinkle over that of the vein-driven model",
                             std::nullopt,
                             "",
                             {Criterion::Kind::at_least, 1},
                             "comes with later models"});
  workshop.done();
  return figure;
}

}  // namespace wilt::detail
