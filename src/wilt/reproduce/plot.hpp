// Plots by gnuplot, each with the script and the numbers that it was made from.
#pragma once

#include <string>
#include <vector>

namespace wilt {

/// A curve or a set of points. Names and labels are gnuplot's enhanced text: K_r, w_{loss}.
struct Series {
  enum class Style { line, points, line_and_points };
  std::string name;          ///< written at its end, in its colour; "" for none
  std::vector<double> x, y;  ///< of one length, >= 1
  Style style = Style::line;
  int colour = -1;  ///< of the palette, 0 to 6; -1: by its place in the panel; kInk: grey
  std::vector<std::string> point_labels{};  ///< none, or one per point
  static constexpr int kInk = 100;
};

struct Panel {
  std::string title, x_label, y_label;  ///< labels with units
  std::vector<Series> series;
  bool equal_axes = false;  ///< one scale for x and y, no axes drawn: a drawing
  bool from_zero = true;    ///< y starts at 0 when no value is below
};

struct Plot {
  std::string name;  ///< of the files, without extension
  std::vector<Panel> panels;
  int columns = 1;
  int panel_width = 460, panel_height = 300;  ///< pixels
};

/// The names of the files that a plot is made of.
struct PlotFiles {
  std::string svg, csv, script;
};

/// Writes NAME.csv (panel,series,x,y), NAME.gp and NAME.svg into `folder`, each whole or not at all. `gnuplot
/// NAME.gp > NAME.svg` there makes the picture again. Throws Error{output}.
PlotFiles write_plot(const Plot& plot, const std::string& folder);

/// The numbers and the script of a plot.
std::string plot_csv(const Plot& plot);
std::string plot_script(const Plot& plot);

/// Throws Error{output}, naming the package, when gnuplot is not there.
void require_gnuplot();

}  // namespace wilt
