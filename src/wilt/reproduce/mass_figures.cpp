// Figures 5 and 14: the mass of the cells, and what its distribution does.
#include <fmt/format.h>

#include <algorithm>

#include "wilt/mesh/geometry.hpp"
#include "wilt/reproduce/figures.hpp"
#include "wilt/reproduce/measures.hpp"
#include "wilt/simulation/regions.hpp"

namespace wilt::detail {
namespace {

constexpr double kFocusRadius = 0.30;  // of L, around the tip of a close-up

std::vector<double> as_vector(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

// The largest difference of mass between two neighbours, as a share of m_max - m_min.
double largest_jump(const Subject& subject, const Eigen::VectorXd& mass, const Config& config) {
  double largest = 0.0;
  for (const EdgeId e : subject.leaf.mesh.edges()) {
    const auto [a, b] = subject.leaf.mesh.edge_vertices(e);
    largest = std::max(largest, std::abs(mass[a] - mass[b]));
  }
  return largest / (config.mass.max - config.mass.min);
}

// The mass over the distance to the nearest vein.
Series mass_profile(const Subject& subject, const Eigen::VectorXd& mass) {
  Series points{"", {}, {}, Series::Style::points, 0};
  for (Eigen::Index v = 0; v < mass.size(); ++v) {
    points.x.push_back(subject.venation.primary_distance[v] / leaf_length(subject.leaf));
    points.y.push_back(mass[v]);
  }
  return points;
}

// The same leaf with the mass of every cell equal to the mean.
Overrides uniform_mass(const Subject& subject, const Config& config) {
  const std::string mean = setting_text(first_mass(subject, config).mean());
  return {{"mass.min", mean}, {"mass.max", mean}};
}

// How far the margin moved, relative to the veins.
double margin_to_vein(const Experiment& experiment) {
  const Eigen::VectorXd moved = displacement(experiment.subject, experiment.result.frames.back());
  return region_mean(experiment.subject, moved, Region::margin) /
         region_mean(experiment.subject, moved, Region::vein);
}

// The vertices around the tip where the two leaves differ most.
std::vector<VertexId> where_they_differ(const Experiment& a, const Experiment& b) {
  const Subject& subject = a.subject;
  const Eigen::VectorXd apart =
      (in_petiole_frame(subject, a.result.frames.back()) - in_petiole_frame(subject, b.result.frames.back()))
          .rowwise()
          .norm();
  std::size_t worst = 0;
  const auto& tips = subject.venation.tips;
  for (std::size_t r = 1; r < tips.size(); ++r) {
    if (apart[tips[r].vertex] > apart[tips[worst].vertex]) worst = r;
  }
  std::vector<VertexId> near;
  for (const VertexId v : subject.leaf.mesh.vertices()) {
    if (subject.venation.tip_distance(static_cast<int>(worst), static_cast<int>(v)) <=
        kFocusRadius * leaf_length(subject.leaf))
      near.push_back(v);
  }
  return near;
}

void add_mass_claims(Figure& figure, const char* model, const Experiment& own, const Experiment& uniform) {
  const double ratio = margin_to_vein(own), uniform_ratio = margin_to_vein(uniform);
  figure.claims.push_back(
      {"fig14",
       "edges-move",
       "With non-uniform mass the margin moves more against the veins",
       model,
       "margin-to-vein displacement, non-uniform / uniform",
       ratio / uniform_ratio,
       "",
       {Criterion::Kind::at_least, 1.05},
       fmt::format("{:.3f} with non-uniform, {:.3f} with uniform mass", ratio, uniform_ratio)});
  const double curl = final_metrics(own).curl, uniform_curl = final_metrics(uniform).curl;
  figure.claims.push_back(
      {"fig14",
       "curls-more",
       "With non-uniform mass the leaf curls more",
       model,
       "curl, non-uniform minus uniform",
       curl - uniform_curl,
       "degrees",
       {Criterion::Kind::at_least, 2.0},
       fmt::format("{:.1f} degrees with non-uniform, {:.1f} with uniform mass", curl, uniform_curl)});
}

}  // namespace

Figure figure_5(Workshop& workshop) {
  workshop.start("figure 5", 2);
  Figure figure{"fig5",
                "Mass of the cells of the maple",
                "The mass of the cells falls gradually from the veins to the margin.",
                {},
                {}};
  const Subject& maple = workshop.experiments().leaf("maple");
  PictureGrid grid{"The leaf at rest from above.", {kModels[0], kModels[1]}, {{"", {}}}};
  Plot plot{"fig5-mass", {}, 2};
  for (const char* model : kModels) {
    const Config config = workshop.experiments().config("maple", model);
    const Eigen::VectorXd mass = first_mass(maple, config);
    grid.rows[0].pictures.push_back(workshop.save(
        fmt::format("fig5-mass-{}", model),
        workshop.pictures().colour_map(maple, mass, config.mass.min, config.mass.max),
        fmt::format("Maple leaf coloured by cell mass, heaviest on the veins, model {}", model)));
    plot.panels.push_back({model,
                           "distance to the nearest vein / length",
                           "cell mass",
                           {mass_profile(maple, mass)},
                           false,
                           false});
    figure.claims.push_back(
        {"fig5",
         "falls",
         "Mass falls from the veins to the margin",
         model,
         "rank correlation of mass and distance to the vein",
         rank_correlation(as_vector(maple.venation.primary_distance), as_vector(mass)),
         "",
         {Criterion::Kind::at_most, -0.9},
         fmt::format("{:.2f} on the veins, {:.2f} at the margin on average",
                     region_mean(maple, mass, Region::vein), region_mean(maple, mass, Region::margin))});
    figure.claims.push_back(
        {"fig5",
         "gradually",
         "Mass falls gradually from cell to cell",
         model,
         "largest step between neighbours, share of the range",
         largest_jump(maple, mass, config),
         "",
         {Criterion::Kind::at_most, 0.25},
         "the printed gd_max belongs to a vein cell, the model cell takes one for the leaf"});
    workshop.done();
  }
  const Config config = workshop.experiments().config("maple", kModels[0]);
  figure.blocks = {std::move(grid), LegendBar{"cell mass m", config.mass.min, config.mass.max},
                   workshop.draw(plot, "Every cell's mass over its distance to the nearest primary vein.",
                                 "Cell mass over distance to the vein, a panel per model")};
  return figure;
}

Figure figure_14(Workshop& workshop) {
  workshop.start("figure 14", 12);
  Figure figure{
      "fig14",
      "Non-uniform and uniform mass",
      "With lighter cells away from the veins the edges accelerate more, and the leaf curls more than with "
      "uniform mass.",
      {},
      {}};
  PictureGrid grid{
      "The maple after 100 iterations, and the lobe where the two differ most. Uniform: every cell has the "
      "mean mass.",
      {"non-uniform", "uniform", "non-uniform, close", "uniform, close"},
      {}};
  for (const char* model : kModels) {
    Experiments& experiments = workshop.experiments();
    const Experiment& own = experiments.run("maple", model);
    workshop.done();
    const Experiment& uniform = experiments.run("maple", model, uniform_mass(own.subject, own.config));
    workshop.done();
    const std::vector<Shot> shots = {{&own, Experiments::kFrames - 1}, {&uniform, Experiments::kFrames - 1}};
    std::vector<Image> images = workshop.pictures().row(shots);
    for (const Image& close : workshop.pictures().close_ups(shots, where_they_differ(own, uniform)))
      images.push_back(close);
    grid.rows.push_back({model, {}});
    constexpr std::array<const char*, 4> kNames = {"own", "uniform", "own-close", "uniform-close"};
    for (std::size_t i = 0; i < images.size(); ++i) {
      const Experiment& shown = i % 2 == 0 ? own : uniform;
      grid.rows.back().pictures.push_back(
          workshop.save(fmt::format("fig14-{}-{}", model, kNames[i]), images[i],
                        fmt::format("Withered maple, {} mass, model {}{}",
                                    i % 2 == 0 ? "non-uniform" : "uniform", model, i < 2 ? "" : ", one lobe"),
                        i < 2 ? fmt::format("margin / veins {:.2f}, curl {:.0f}°", margin_to_vein(shown),
                                            final_metrics(shown).curl)
                              : ""));
    }
    workshop.done(4);
    add_mass_claims(figure, model, own, uniform);
  }
  figure.blocks.emplace_back(std::move(grid));
  return figure;
}

}  // namespace wilt::detail
