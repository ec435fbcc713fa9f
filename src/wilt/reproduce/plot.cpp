#include "wilt/reproduce/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/reproduce/claims.hpp"
#include "wilt/reproduce/program.hpp"

namespace wilt {
namespace {

// Okabe and Ito 2008, "Color Universal Design": distinct under every kind of colour blindness. Blue first;
// yellow is left out, it cannot be read on white.
constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#000000"};
constexpr const char* kInkColour = "#8a8a8a";
constexpr std::size_t kManyPoints = 500;  // drawn smaller
constexpr double kLabelGap = 0.075;       // least distance between labels of curves, of the height

constexpr const char* kStyle = R"(set encoding utf8
set datafile separator comma
set key off
set xlabel textcolor '#404040'
set ylabel textcolor '#404040'
)";

constexpr const char* kAxes = R"(set border 3 linecolor '#707070' linewidth 1
set xtics nomirror out scale 0.6 textcolor '#404040'
set ytics nomirror out scale 0.6 textcolor '#404040'
set grid ytics linecolor '#e4e4e4' linewidth 1
set size noratio
set lmargin 12
)";

constexpr const char* kNoAxes = R"(unset border
unset xtics
unset ytics
unset grid
set size ratio -1
set lmargin 2
set rmargin 2
set xlabel ''
set ylabel ''
)";

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void take(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double width() const { return most - least; }
  double middle() const { return 0.5 * (least + most); }
};

Range range_of(const Panel& panel, std::vector<double> Series::*values) {
  Range range;
  for (const Series& s : panel.series) {
    for (const double value : s.*values) range.take(value);
  }
  if (!(range.width() > 0.0)) range = {std::min(range.least, 0.0), std::max(range.most, 0.0) + 1.0};
  return range;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string colour_of(const Series& series, std::size_t place) {
  if (series.colour == Series::kInk) return kInkColour;
  const std::size_t index = series.colour < 0 ? place : static_cast<std::size_t>(series.colour);
  return kColours[index % kColours.size()];
}

// The heights at which the curves' names stand: at their ends, moved apart where they would collide.
std::vector<double> label_heights(const Panel& panel, const Range& y) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (!panel.series[i].name.empty()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return panel.series[a].y.back() < panel.series[b].y.back();
  });
  std::vector<double> heights(panel.series.size());
  const double gap = kLabelGap * y.width();
  for (const std::size_t i : order) heights[i] = panel.series[i].y.back();
  for (std::size_t k = 1; k < order.size(); ++k)
    heights[order[k]] = std::max(heights[order[k]], heights[order[k - 1]] + gap);
  const double over = order.empty() ? 0.0 : heights[order.back()] - (y.most + 0.5 * gap);
  if (over > 0.0 && order.size() > 1) {  // back below the top, pushing the lower ones down
    heights[order.back()] -= over;
    for (std::size_t k = order.size() - 1; k-- > 0;)
      heights[order[k]] = std::min(heights[order[k]], heights[order[k + 1]] - gap);
  }
  return heights;
}

std::string style_of(const Series& series, std::size_t place) {
  const std::string colour = colour_of(series, place);
  const std::string point = fmt::format("pointtype 7 pointsize {} linecolor rgb '{}'",
                                        series.x.size() > kManyPoints ? 0.25 : 0.5, colour);
  const std::string line =
      fmt::format("linewidth {} dashtype {} linecolor rgb '{}'", series.colour == Series::kInk ? 1.0 : 1.8,
                  series.colour < 0 && place > 0 ? fmt::format("{}", place % 5 + 1) : "1", colour);
  if (series.style == Series::Style::points) return "points " + point;
  if (series.style == Series::Style::line) return "lines " + line;
  return "linespoints pointtype 7 pointsize 0.5 " + line;
}

// Beside a point, away from the middle of a drawing; above it in a diagram.
std::string point_label(const Panel& panel, const Series& series, std::size_t k, const Range& x,
                        const Range& y, const std::string& colour) {
  double right = 0.0, up = 0.75;
  if (panel.equal_axes) {
    right = 3.2 * (series.x[k] - x.middle()) / x.width();
    up = 1.6 * (series.y[k] - y.middle()) / y.width();
  }
  return fmt::format("set label {} at {:.9g}, {:.9g} center offset {:.2f}, {:.2f} textcolor rgb '{}'\n",
                     quoted(series.point_labels[k]), series.x[k], series.y[k], right, up, colour);
}

std::string labels_of(const Panel& panel, const Range& x, const Range& y) {
  std::string text = "unset label\n";
  const std::vector<double> heights = label_heights(panel, y);
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& s = panel.series[i];
    const std::string colour = s.colour == Series::kInk ? "#606060" : colour_of(s, i);
    if (!s.name.empty() && !panel.equal_axes)
      text += fmt::format("set label {} at {:.9g}, {:.9g} left offset 0.6, 0 textcolor rgb '{}'\n",
                          quoted(s.name), s.x.back(), heights[i], colour);
    for (std::size_t k = 0; k < s.point_labels.size(); ++k) text += point_label(panel, s, k, x, y, colour);
  }
  return text;
}

// How many letters of room the curves' names need on the right.
std::size_t name_length(const Panel& panel) {
  std::size_t longest = 0;
  for (const Series& s : panel.series) {
    const auto shown = [](char c) { return c != '{' && c != '}' && c != '_'; };
    longest = std::max(longest, static_cast<std::size_t>(std::count_if(s.name.begin(), s.name.end(), shown)));
  }
  return longest;
}

std::string axes_of(const Panel& panel, const Range& x, const Range& y) {
  std::string text = fmt::format("set title {} font ',14' textcolor '#202020'\n", quoted(panel.title));
  if (panel.equal_axes) {
    text += kNoAxes;
    const double pad = 0.08 * std::max(x.width(), y.width());
    return text + fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n", x.least - pad,
                              x.most + pad, y.least - pad, y.most + pad);
  }
  text += fmt::format("{}set rmargin {}\n", kAxes, 3 + name_length(panel));
  text += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(panel.x_label), quoted(panel.y_label));
  const double bottom = panel.from_zero && y.least >= 0.0 ? 0.0 : y.least - 0.05 * y.width();
  const double top = y.most + 0.1 * (y.most - bottom);
  return text + fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n", x.least, x.most,
                            bottom, top);
}

std::string curves_of(const Plot& plot, std::size_t panel) {
  std::string text = "plot ";
  const auto& series = plot.panels[panel].series;
  for (std::size_t i = 0; i < series.size(); ++i)
    text += fmt::format(
        "{}'{}.csv' skip 1 using (column(1) == {} && column(3) == {} ? column(5) : NaN):6 with {}",
        i == 0 ? "" : ", \\\n     ", plot.name, panel + 1, i + 1, style_of(series[i], i));
  return text + "\n";
}

}  // namespace

std::string plot_csv(const Plot& plot) {
  std::string text = "panel,panel_title,series,series_name,x,y\n";
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const auto& series = plot.panels[p].series;
    for (std::size_t i = 0; i < series.size(); ++i) {
      WILT_CHECK(!series[i].x.empty() && series[i].x.size() == series[i].y.size(), series[i].x.size(),
                 series[i].y.size(), plot.name, series[i].name);
      for (std::size_t k = 0; k < series[i].x.size(); ++k)
        text += fmt::format("{},{},{},{},{:.9g},{:.9g}\n", p + 1, csv_field(plot.panels[p].title), i + 1,
                            csv_field(series[i].name), series[i].x[k], series[i].y[k]);
    }
  }
  return text;
}

std::string plot_script(const Plot& plot) {
  const int count = static_cast<int>(plot.panels.size());
  const int rows = (count + plot.columns - 1) / plot.columns;
  std::string text = fmt::format(
      "# gnuplot {0}.gp > {0}.svg\nset terminal svg size {1},{2} dynamic enhanced background '#ffffff' font "
      "'Helvetica,13'\n",
      plot.name, plot.columns * plot.panel_width, rows * plot.panel_height);
  text += kStyle;
  text += fmt::format("set multiplot layout {},{}\n", rows, plot.columns);
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const Range x = range_of(plot.panels[p], &Series::x), y = range_of(plot.panels[p], &Series::y);
    text += axes_of(plot.panels[p], x, y) + labels_of(plot.panels[p], x, y) + curves_of(plot, p);
  }
  return text + "unset multiplot\n";
}

PlotFiles write_plot(const Plot& plot, const std::string& folder) {
  const PlotFiles files{plot.name + ".svg", plot.name + ".csv", plot.name + ".gp"};
  write_file(folder + "/" + files.csv, plot_csv(plot));
  write_file(folder + "/" + files.script, plot_script(plot));
  const ProgramOutput drawn = run_program("gnuplot", {files.script}, folder);
  if (!drawn.started) require_gnuplot();
  if (drawn.exit_code != 0 || drawn.text.find("</svg>") == std::string::npos)
    throw Error(
        ErrorCode::output,
        fmt::format("gnuplot could not draw '{0}/{1}' (exit code {2}); run `gnuplot {1}` there to see why",
                    folder, files.script, drawn.exit_code));
  write_file(folder + "/" + files.svg, drawn.text);
  return files;
}

void require_gnuplot() {
  const ProgramOutput found = run_program("gnuplot", {"--version"}, "/");
  if (!found.started || found.exit_code != 0)
    throw Error(
        ErrorCode::output,
        "the plots need gnuplot, which is not there; install it (Debian: apt-get install gnuplot-nox)");
}

}  // namespace wilt
