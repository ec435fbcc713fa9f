#include "wilt/render/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/error.hpp"

namespace wilt {

Image contact_sheet(const std::vector<Image>& images, int columns, int gap,
                    std::array<std::uint8_t, 3> background) {
  if (images.empty()) throw Error(ErrorCode::input, "a contact sheet needs at least one picture, got none");
  if (columns < 1 || gap < 0) {
    throw Error(ErrorCode::configuration,
                fmt::format("contact sheet: columns is {} (allowed: >= 1) and gap is {} (allowed: >= 0)",
                            columns, gap));
  }
  int cell_width = 0, cell_height = 0;
  for (const Image& image : images) {
    cell_width = std::max(cell_width, image.width);
    cell_height = std::max(cell_height, image.height);
  }
  columns = std::min<int>(columns, images.size());
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;

  Image sheet{columns * (cell_width + gap) + gap, rows * (cell_height + gap) + gap, {}};
  sheet.rgb.resize(3 * std::size_t(sheet.width) * sheet.height);
  for (std::size_t i = 0; i < sheet.rgb.size(); ++i) sheet.rgb[i] = background[i % 3];
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    const Image& image = images[i];
    const int left = gap + (i % columns) * (cell_width + gap) + (cell_width - image.width) / 2;
    const int top = gap + (i / columns) * (cell_height + gap) + (cell_height - image.height) / 2;
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.pixel(0, y), 3 * image.width, sheet.pixel(left, top + y));
  }
  return sheet;
}

}  // namespace wilt
