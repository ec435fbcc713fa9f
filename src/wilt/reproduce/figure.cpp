#include "wilt/reproduce/figure.hpp"

namespace wilt {
namespace {

struct FileNames {
  std::vector<std::string>& names;

  void operator()(const PictureGrid& grid) const {
    for (const auto& row : grid.rows) {
      for (const Picture& picture : row.pictures) names.push_back(picture.file);
    }
  }
  void operator()(const PictureStrips& strips) const {
    for (const auto& row : strips.rows) names.push_back(row.strip.file);
  }
  void operator()(const PlotBlock& plot) const {
    names.insert(names.end(), {plot.files.svg, plot.files.csv, plot.files.script});
  }
  void operator()(const Paragraph&) const {}
  void operator()(const TableBlock&) const {}
  void operator()(const LegendBar&) const {}
};

}  // namespace

std::vector<std::string> files_of(const Figure& figure) {
  std::vector<std::string> names;
  for (const Block& block : figure.blocks) std::visit(FileNames{names}, block);
  return names;
}

}  // namespace wilt
