// A figure of the paper, reproduced: what was claimed, what was found, and the files that show it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "wilt/reproduce/claims.hpp"
#include "wilt/reproduce/plot.hpp"

namespace wilt {

/// A picture beside the report.
struct Picture {
  std::string file, alt;
  std::string caption;  ///< short: the figures of this leaf
};

/// Pictures in rows and columns with labels.
struct PictureGrid {
  std::string caption;
  std::vector<std::string> columns;  ///< headings, or none
  struct Row {
    std::string label;
    std::vector<Picture> pictures;
  };
  std::vector<Row> rows;
};

/// One picture per row that holds all columns, as wide as the page.
struct PictureStrips {
  std::string caption;
  std::vector<std::string> columns;  ///< headings over equal parts of each strip
  struct Row {
    std::string label;
    Picture strip;
  };
  std::vector<Row> rows;
};

struct PlotBlock {
  std::string caption, alt;
  PlotFiles files;
};

struct TableBlock {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// The meaning of a colour map (viridis) from `least` to `most`.
struct LegendBar {
  std::string label;
  double least = 0.0, most = 1.0;
};

struct Paragraph {
  std::string text;
};

using Block = std::variant<Paragraph, PictureGrid, PictureStrips, PlotBlock, TableBlock, LegendBar>;

struct Figure {
  std::string id;     ///< "fig7", "table1"
  std::string title;  ///< "Swelling wrinkles, external forces curl"
  std::string claim;  ///< what the paper says, in our words
  std::vector<Block> blocks;
  std::vector<Claim> claims;
};

}  // namespace wilt
