#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "wilt/core/version.hpp"
#include "wilt/output/markup.hpp"
#include "wilt/output/vein_lines.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

constexpr double kMillimetres = 1000.0;

// The leaf seen from above: x to the right, y downwards as SVG has it, millimetres.
Points2 top_view(const Points3& points) {
  Points2 flat(points.rows(), 2);
  flat.col(0) = kMillimetres * points.col(0);
  flat.col(1) = -kMillimetres * points.col(1);
  return flat;
}

std::string polygon(const Points2& points) {
  std::string path;
  for (int i = 0; i < points.rows(); ++i)
    fmt::format_to(std::back_inserter(path), "{}{:.3f} {:.3f}", i == 0 ? "M" : " L", points(i, 0),
                   points(i, 1));
  return path + " Z";
}

// The band around a polyline whose half width falls linearly from `start` to `end`.
Points2 band(const Points2& line, double start, double end) {
  const int count = static_cast<int>(line.rows());
  Points2 outline(2 * count, 2);
  Vec2 along = Vec2::UnitX();
  for (int i = 0; i < count; ++i) {
    const Vec2 step = line.row(std::min(i + 1, count - 1)) - line.row(std::max(i - 1, 0));
    if (step.norm() > 0.0) along = step.normalized();
    const double half = start + (end - start) * i / std::max(count - 1, 1);
    const Vec2 across(-along.y() * half, along.x() * half);
    outline.row(i) = line.row(i) + across.transpose();
    outline.row(2 * count - 1 - i) = line.row(i) - across.transpose();
  }
  return outline;
}

/// What is drawn, in millimetres, and how large.
struct Drawing {
  Points2 blade, stalk;
  Vec2 low, high;       // the corners of the picture
  double length = 0.0;  // of the blade's diagonal, to which widths and letters are scaled
};

Drawing measure(const Leaf& leaf) {
  Drawing drawing{top_view(leaf.positions), top_view(leaf.stalk.centreline), Vec2::Zero(), Vec2::Zero()};
  const Vec2 blade_low = drawing.blade.colwise().minCoeff(), blade_high = drawing.blade.colwise().maxCoeff();
  drawing.length = (blade_high - blade_low).norm();
  drawing.low = blade_low;
  drawing.high = blade_high;
  if (drawing.stalk.rows() > 0) {
    drawing.low = drawing.low.cwiseMin(drawing.stalk.colwise().minCoeff().transpose());
    drawing.high = drawing.high.cwiseMax(drawing.stalk.colwise().maxCoeff().transpose());
  }
  const double margin = 0.06 * drawing.length;
  drawing.low.array() -= margin;
  drawing.high.array() += margin;
  return drawing;
}

void append_blade(std::string& svg, const Leaf& leaf, const Drawing& drawing) {
  std::string path;
  for (const auto& loop : leaf.mesh.boundary_loops()) {
    Points2 points(static_cast<int>(loop.size()), 2);
    for (int i = 0; i < points.rows(); ++i)
      points.row(i) = drawing.blade.row(loop[static_cast<std::size_t>(i)]);
    path += (path.empty() ? "" : " ") + polygon(points);
  }
  fmt::format_to(std::back_inserter(svg),
                 "  <path class=\"blade\" d=\"{}\" fill=\"#dfe8cd\" fill-rule=\"evenodd\" stroke=\"#5d7a3a\" "
                 "stroke-width=\"{:.3f}\" stroke-linejoin=\"round\"/>\n",
                 path, 0.003 * drawing.length);
}

void append_veins(std::string& svg, const std::vector<RestVein>& lines, int order, double length) {
  const double start = (order == 1 ? 0.0045 : 0.0018) * length, end = start / 5.0;
  fmt::format_to(std::back_inserter(svg), "  <g class=\"veins order-{}\" fill=\"{}\">\n", order,
                 order == 1 ? "#4c6b2a" : "#7f9a58");
  for (const RestVein& line : lines) {
    if (line.order != order || line.positions.rows() < 2) continue;
    fmt::format_to(std::back_inserter(svg), "    <path d=\"{}\"/>\n",
                   polygon(band(top_view(line.positions), start, end)));
  }
  svg += "  </g>\n";
}

// A dot at every tip, and its number a little further out, seen from the petiole.
void append_tips(std::string& svg, const Leaf& leaf, const Venation& venation, const Drawing& drawing) {
  const double size = 0.03 * drawing.length;
  fmt::format_to(std::back_inserter(svg),
                 "  <g class=\"tips\" fill=\"#8a3b12\" font-family=\"sans-serif\" font-size=\"{:.3f}\" "
                 "text-anchor=\"middle\">\n",
                 size);
  const Vec2 petiole = drawing.blade.row(leaf.petiole);
  int number = 0;
  for (const Tip& tip : venation.tips) {
    const Vec2 at = drawing.blade.row(tip.vertex);
    const Vec2 outwards = (at - petiole).norm() > 0.0 ? Vec2((at - petiole).normalized()) : Vec2(0.0, -1.0);
    const Vec2 text = at + outwards * size + Vec2(0.0, 0.35 * size);
    fmt::format_to(
        std::back_inserter(svg),
        "    <circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\"/><text x=\"{:.3f}\" y=\"{:.3f}\">{}</text>\n",
        at.x(), at.y(), 0.25 * size, text.x(), text.y(), ++number);
  }
  svg += "  </g>\n";
}

}  // namespace

std::string veins_svg(const Leaf& leaf, const Venation& venation) {
  const Drawing drawing = measure(leaf);
  const Vec2 size = drawing.high - drawing.low;
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"{2:.3f} {3:.3f} {0:.3f} {1:.3f}\">\n"
      "  <title>{4}: {5} tips</title>\n  <desc>wilt {6}; the leaf at rest from above, millimetres</desc>\n",
      size.x(), size.y(), drawing.low.x(), drawing.low.y(), markup_text(leaf.name), venation.tips.size(),
      version());
  if (drawing.stalk.rows() >= 2) {
    fmt::format_to(std::back_inserter(svg), "  <path class=\"stalk\" d=\"{}\" fill=\"#786e3c\"/>\n",
                   polygon(band(drawing.stalk, kMillimetres * leaf.stalk.radii.front(),
                                kMillimetres * leaf.stalk.radii.back())));
  }
  append_blade(svg, leaf, drawing);
  const std::vector<RestVein> lines = vein_lines(leaf, venation);
  append_veins(svg, lines, 2, drawing.length);
  append_veins(svg, lines, 1, drawing.length);
  append_tips(svg, leaf, venation, drawing);
  return svg + "</svg>\n";
}

}  // namespace wilt
