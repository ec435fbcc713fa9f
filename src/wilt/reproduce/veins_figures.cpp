// Figures 2 and 6: the boundary expansion, its peaks, the primary veins.
#include <fmt/format.h>

#include <map>

#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/reproduce/figures.hpp"

namespace wilt::detail {
namespace {

constexpr int kMostWindow = 30;  // margin vertices of a half window

// How many tips a leaf of each species has: one per lobe, or the apex alone.
const std::map<std::string, int> kTips = {{"maple", 7}, {"poplar", 1}, {"tilia", 1},
                                          {"ivy", 5},   {"willow", 1}, {"grape", 5}};

// Metres become millimetres.
void add_point(Series& series, double x, double y) {
  series.x.push_back(1e3 * x);
  series.y.push_back(1e3 * y);
}

Series margin_in_plane(const Venation& venation) {
  Series series{"", {}, {}, Series::Style::points, Series::kInk};
  for (const int v : venation.margin.vertices) add_point(series, venation.flat(v, 0), venation.flat(v, 1));
  return series;
}

std::string tip_name(std::size_t r) {
  return fmt::format("r_{{{}}}", r + 1);
}

Panel plane_panel(const Venation& venation) {
  Panel panel{"Margin in the plane", "", "", {margin_in_plane(venation)}, true};
  Series tips{"tips", {}, {}, Series::Style::points, 1};
  for (std::size_t r = 0; r < venation.tips.size(); ++r) {
    const int v = venation.tips[r].vertex;
    add_point(tips, venation.flat(v, 0), venation.flat(v, 1));
    tips.point_labels.push_back(tip_name(r));
  }
  panel.series.push_back(std::move(tips));
  panel.series.push_back({"petiole", {0.0}, {0.0}, Series::Style::points, 0, {"v_o"}});
  return panel;
}

Panel expansion_panel(const Venation& venation, const std::string& title) {
  Panel panel{title, "s along the margin, mm", "d to the petiole, mm", {}};
  const MarginProfile& margin = venation.margin;
  Series curve{"", {}, {}, Series::Style::line, 0};
  for (Eigen::Index i = 0; i < margin.s.size(); ++i) add_point(curve, margin.s(i), margin.d(i));
  Series peaks{"", {}, {}, Series::Style::points, 1};
  for (std::size_t r = 0; r < venation.tips.size(); ++r) {
    add_point(peaks, venation.tips[r].s, venation.tips[r].d);
    peaks.point_labels.push_back(tip_name(r));
  }
  panel.series = {std::move(curve), std::move(peaks)};
  return panel;
}

Panel veins_panel(const Subject& subject) {
  const Leaf& leaf = subject.leaf;
  Panel panel{"Primary veins", "", "", {}, true};
  Series outline{"", {}, {}, Series::Style::line, Series::kInk};
  std::vector<VertexId> loop = margin_loop(leaf.mesh, leaf.positions);
  loop.push_back(loop.front());
  for (const int v : loop) add_point(outline, leaf.positions(v, 0), leaf.positions(v, 1));
  panel.series.push_back(std::move(outline));
  for (const Vein& vein : subject.venation.veins) {
    if (vein.order != 1) continue;
    Series line{"", {}, {}, Series::Style::line, 2};
    for (const SurfacePoint& point : vein.path.points) {
      const Vec3 p = position(leaf.mesh, leaf.positions, point);
      add_point(line, p.x(), p.y());
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

// The half windows for which the printed rule finds the tips of a species, all of them and nothing else.
std::vector<int> windows_that_serve(const Venation& venation) {
  std::vector<int> windows;
  for (int k = 1; k <= kMostWindow; ++k) {
    PeakOptions options;
    options.rule = PeakRule::window;
    options.window_vertices = k;
    std::vector<int> found, tips;
    for (const Peak& peak : find_peaks(venation.margin, options))
      found.push_back(venation.margin.vertices[static_cast<std::size_t>(peak.index)]);
    for (const Tip& tip : venation.tips) tips.push_back(tip.vertex);
    if (found == tips) windows.push_back(k);
  }
  return windows;
}

std::string window_text(const std::vector<int>& windows) {
  if (windows.empty()) return "none";
  return fmt::format("{}", fmt::join(windows, " "));
}

}  // namespace

Figure figure_2(Workshop& workshop) {
  workshop.start("figure 2", 2);
  const Subject& maple = workshop.experiments().leaf("maple");
  workshop.done();
  Figure figure{
      "fig2",
      "Boundary expansion of the maple",
      "Walking round the margin of the flattened leaf and plotting the distance from the petiole over the "
      "way walked gives a curve whose peaks are the tips; geodesics to them are the primary veins.",
      {},
      {}};
  Plot plot{"fig2-expansion",
            {plane_panel(maple.venation), expansion_panel(maple.venation, "Boundary expansion"),
             veins_panel(maple)},
            3,
            400,
            340};
  figure.blocks.emplace_back(workshop.draw(
      plot,
      "The margin after multidimensional scaling, the curve d(s) with its peaks, and the veins to them.",
      "Three panels: margin points of the maple in the plane, boundary expansion curve with peaks r1 to r7, "
      "outline with seven primary veins"));
  const int tips = static_cast<int>(maple.venation.tips.size());
  for (const char* model : kModels)
    figure.claims.push_back(
        {"fig2",
         "peaks",
         "The peaks of the expansion are the tips of the maple's lobes",
         model,
         "peaks found",
         tips,
         "",
         {Criterion::Kind::exactly, static_cast<double>(kTips.at("maple"))},
         fmt::format("normalised stress of the embedding {:.2g}; the same for both models",
                     maple.venation.embedding_stress)});
  workshop.done();
  return figure;
}

Figure figure_6(Workshop& workshop) {
  workshop.start("figure 6", 13);
  Figure figure{
      "fig6",
      "Veins of six species",
      "Feature points are found accurately on all species, and the primary veins match those of real leaves.",
      {},
      {}};
  PictureGrid grid{"Rest leaves from above; primary veins drawn over the blade.", {}, {{"", {}}, {"", {}}}};
  Plot plot{"fig6-expansion", {}, 3, 400, 260};
  TableBlock table{
      fmt::format("Tips found, and the half windows (of 1 to {} margin vertices) for which the printed "
                  "condition finds the same.",
                  kMostWindow),
      {"species", "tips expected", "tips found", "windows of the printed rule that find them"},
      {}};
  int right = 0;
  std::map<int, int> served;  // half window -> species
  for (const std::string& name : species_names()) {
    const Subject& subject = workshop.experiments().leaf(name);
    workshop.done();
    const int expected = kTips.at(name), found = static_cast<int>(subject.venation.tips.size());
    right += found == expected ? 1 : 0;
    const std::vector<int> windows = windows_that_serve(subject.venation);
    for (const int k : windows) ++served[k];
    table.rows.push_back({name, fmt::format("{}", expected), fmt::format("{}", found), window_text(windows)});
    plot.panels.push_back(expansion_panel(subject.venation, name));
    auto& row = grid.rows[grid.rows[0].pictures.size() < 3 ? 0 : 1].pictures;
    row.push_back(workshop.save("fig6-" + name,
                                workshop.pictures().veins(workshop.experiments().run(name, "cell")),
                                fmt::format("{} leaf from above with {} primary veins", name, found),
                                fmt::format("{}: {} tip{}", name, found, found == 1 ? "" : "s")));
    workshop.done();
  }
  int most = 0;
  std::vector<int> best;
  for (const auto& [window, count] : served) {
    if (count > most) best.clear();
    if (count >= most) best.push_back(window);
    most = std::max(most, count);
  }
  figure.blocks = {std::move(grid),
                   workshop.draw(plot, "Boundary expansion of each species with the peaks that were taken.",
                                 "Six boundary expansion curves with their peaks marked"),
                   std::move(table)};
  for (const char* model : kModels) {
    figure.claims.push_back({"fig6",
                             "tips",
                             "The tips of all six species are found",
                             model,
                             "species with the right number of tips",
                             right,
                             "",
                             {Criterion::Kind::at_least, 6},
                             "peaks by prominence; the same for both models"});
    figure.claims.push_back(
        {"fig6",
         "window",
         "One sliding window, as printed, serves all six species",
         model,
         "species that the best half window serves",
         most,
         "",
         {Criterion::Kind::at_least, 6},
         fmt::format("of half windows of 1 to {} vertices best: {}", kMostWindow, window_text(best))});
  }
  workshop.done();
  return figure;
}

}  // namespace wilt::detail
