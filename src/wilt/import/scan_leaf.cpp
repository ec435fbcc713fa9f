#include "wilt/import/scan_leaf.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/import/mesh_file.hpp"
#include "wilt/import/mesh_leaf.hpp"
#include "wilt/import/regions.hpp"
#include "wilt/import/scan_chart.hpp"
#include "wilt/import/scan_cleaning.hpp"
#include "wilt/import/scan_limits.hpp"
#include "wilt/import/scan_margin.hpp"
#include "wilt/import/scan_stalk.hpp"
#include "wilt/import/smooth_surface.hpp"
#include "wilt/import/surface_petiole.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/leaf/relief.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::detail {
namespace {

// In spacings of the points:
constexpr double kKnotSpacing = 2.0;  // of the surface
constexpr double kTrailReach = 8.0;   // between the points of a stalk

Points3 surface_points(const SmoothSurface& surface, const Points2& uv) {
  Points3 points(uv.rows(), 3);
  for (Eigen::Index i = 0; i < uv.rows(); ++i) points.row(i) = surface.at(uv.row(i).transpose()).transpose();
  return points;
}

SmoothSurface fit_surface(const CleanScan& clean, const ScanChart& chart) {
  Points3 points(chart.uv.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = clean.points.row(chart.points[i]);
  return SmoothSurface(chart.uv, points, kKnotSpacing * clean.spacing);
}

// A scan of a stalk tells its mean thickness, not more.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Says how good the scan is; refuses one that is too noisy.
void judge(const CleanScan& clean, const SmoothSurface& surface, const ScanMargin& margin,
           std::vector<std::string>& notes) {
  const double size = std::sqrt(area_of(margin.outline)), share = surface.noise() / size;
  const auto used = std::count(margin.inside.begin(), margin.inside.end(), 1);
  const std::string figures = fmt::format(
      "{} points of the blade {:.3g} apart lie {:.2g} units off the surface (root mean square), {:.2g} % "
      "of the blade's size",
      used, clean.spacing, surface.noise(), 100 * share);
  if (share > kMostNoise)
    throw Error(
        ErrorCode::input,
        fmt::format("the scan is too noisy: {}; {:.1f} % are allowed. Average several scans, or cut away "
                    "what is not this leaf",
                    figures, 100 * kMostNoise));
  notes.push_back(figures);
  if (share > kMuchNoise)
    notes.push_back(fmt::format(
        "that is much (above {:.1f} %): relief finer than the noise was smoothed away", 100 * kMuchNoise));
  const double left_out = 1.0 - static_cast<double>(used) / static_cast<double>(margin.inside.size());
  if (left_out > kMuchLeftOut)
    notes.push_back(
        fmt::format("{:.0f} % of the points lie beyond the margin that was found: the scan is "
                    "sparse in places",
                    100 * left_out));
  if (surface.outliers() > kManyOutliers)
    notes.push_back(fmt::format("{:.0f} % of the points lie far off the surface and were left out",
                                100 * surface.outliers()));
}

double settle_unit(const Points3& blade, const ReadOptions& options, std::vector<std::string>& notes) {
  if (options.mm_per_unit) return *options.mm_per_unit / 1000.0;
  const double extent = (blade.colwise().maxCoeff() - blade.colwise().minCoeff()).norm();
  const bool metres = extent < 2.0;
  notes.push_back(
      fmt::format("the blade's box is {:.3g} units across: they are taken to be {} (--mm-per-unit says "
                  "otherwise)",
                  extent, metres ? "metres" : "millimetres"));
  return metres ? 1.0 : 0.001;
}

// What is left of the scan beside the blade: strays, other pieces, what lies beyond the margin.
Points3 loose_points(const CleanScan& clean, const ScanChart& chart, const ScanMargin& margin) {
  std::vector<char> of_blade(clean.points.rows(), 0);
  for (std::size_t i = 0; i < chart.points.size(); ++i) of_blade[chart.points[i]] = margin.inside[i];
  const auto count = std::count(of_blade.begin(), of_blade.end(), 0);
  Points3 loose(count + clean.strays.rows(), 3);
  Eigen::Index next = 0;
  for (int i = 0; i < clean.points.rows(); ++i) {
    if (!of_blade[i]) loose.row(next++) = clean.points.row(i);
  }
  loose.bottomRows(clean.strays.rows()) = clean.strays;
  return loose;
}

// A scan in the plane.
struct FlatScan {
  const CleanScan& clean;
  const ScanChart& chart;
  const SmoothSurface& surface;
  const ScanMargin& margin;
  bool y_up;  // as in the file
};

// The petiole in the plane, on the margin that the cut left.
Vec2 settle_petiole(const FlatScan& scan, const StalkCut& cut, const ReadOptions& options,
                    std::vector<std::string>& notes) {
  const Points2& flat = cut.blade.margin;
  const auto in_file = [&](const Vec3& p) -> Vec3 { return scan.y_up ? to_file_axes(p) : p; };
  const Points3 margin = surface_points(scan.surface, flat);
  Points3 shown = margin;
  for (int i = 0; i < margin.rows(); ++i) shown.row(i) = in_file(margin.row(i).transpose()).transpose();
  if (options.petiole)
    return flat.row(given_petiole(shown, in_file(scan.chart.normal), *options.petiole, notes)).transpose();
  const auto say = [&](const char* what, const Vec3& at) {
    notes.push_back(fmt::format("{}, at ({:.4g}, {:.4g}, {:.4g})", what, at.x(), at.y(), at.z()));
  };
  if (cut.found) {
    say("a stalk was cut off; the petiole is where it met the blade", in_file(scan.surface.at(cut.petiole)));
    return cut.petiole;
  }
  const Points3 loose = loose_points(scan.clean, scan.chart, scan.margin);
  const double size = std::sqrt(area_of(cut.blade));
  if (const auto foot = find_stalk_trail(loose, margin, kTrailReach * scan.clean.spacing, size)) {
    say("a trail of points leads away from the blade; the petiole is where it begins", shown.row(*foot));
    return flat.row(*foot).transpose();
  }
  return flat.row(guessed_petiole(flat, shown, notes)).transpose();
}

// The layout with the petiole below the blade's centre, as texture coordinates.
Skin flat_skin(const SurfaceMesh& mesh, const Points2& flat, VertexId petiole) {
  const Eigen::RowVector2d base = flat.row(petiole);
  const Eigen::RowVector2d up = (flat.colwise().mean() - base).normalized();
  Points3 turned = Points3::Zero(flat.rows(), 3);
  turned.col(1) = (flat.rowwise() - base) * up.transpose();
  turned.col(0) = (flat.rowwise() - base) * Vec2(up.y(), -up.x());
  return planar_skin(mesh, turned);
}

}  // namespace

Leaf leaf_from_scan(Scan scan, const std::string& name, const ReadOptions& options, const Monitor& monitor) {
  Leaf leaf;
  leaf.name = name;
  leaf.species = "generic";
  leaf.seed = options.seed;
  leaf.notes = std::move(scan.notes);
  monitor.report("cleaning the scan", 0.0);
  const CleanScan clean = clean_scan(scan.points, leaf.notes);
  monitor.throw_if_cancelled();
  monitor.report("laying out the scan", 0.3);
  const ScanChart chart = lay_out(clean, options.nth, leaf.notes, monitor);
  monitor.throw_if_cancelled();
  monitor.report("fitting the surface", 0.6);
  const SmoothSurface surface = fit_surface(clean, chart);
  const ScanMargin margin =
      find_scan_margin(surface.uv(), {clean.spacing, clean.coarse_spacing, surface.noise()});
  judge(clean, surface, margin, leaf.notes);

  const StalkCut cut = cut_stalk(margin.outline);
  MeshingOptions meshing;
  meshing.vertices = options.vertices.value_or(meshing.vertices);
  meshing.smallest_angle += kReliefReserve;
  meshing.keep = {settle_petiole({clean, chart, surface, margin, scan.y_up}, cut, options, leaf.notes)};
  PlanarMesh planar = mesh_outline(cut.blade, meshing, monitor);
  leaf.mesh = std::move(planar.mesh);
  const Points3 positions = surface_points(surface, planar.positions);
  validate_blade(leaf.mesh, positions);
  place_in_leaf_frame(leaf, positions, planar.kept.front(), settle_unit(positions, options, leaf.notes));
  if (cut.found)
    place_stalk(leaf, surface_points(surface, cut.centreline),
                std::vector<double>(cut.half_widths.size(), median(cut.half_widths)));
  leaf.skin = flat_skin(leaf.mesh, planar.positions, leaf.petiole);
  note_implausible_length(leaf, "give --mm-per-unit");
  return leaf;
}

}  // namespace wilt::detail
