// What the native reader cuts out of photos, for the comparison with the page's: native_cut_out PIXELS_FOLDER
// PHOTO... writes each photo's pixels (RGBA) to PIXELS_FOLDER/N.rgba and prints a JSON array of {width,
// height, leaves, margin, fork, texture}: rings as [x, y, ...] in pixels of the file, y down.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/import/photo_cover.hpp"
#include "wilt/import/photo_file.hpp"
#include "wilt/import/photo_objects.hpp"
#include "wilt/import/photo_outline.hpp"
#include "wilt/import/photo_petiole.hpp"
#include "wilt/import/photo_texture.hpp"
#include "wilt/leaf/petiole.hpp"

namespace {

using namespace wilt;
using nlohmann::json;

std::vector<double> y_down(const Points2& ring) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < ring.rows(); ++i) numbers.insert(numbers.end(), {ring(i, 0), -ring(i, 1)});
  return numbers;
}

void write_pixels(const std::string& bytes, const std::string& path, json& result) {
  const Image image = decode_image(bytes);
  const std::vector<std::uint8_t> alpha = decode_alpha(bytes);
  std::string pixels;
  for (std::size_t i = 0; 3 * i < image.rgb.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) pixels.push_back(static_cast<char>(image.rgb[3 * i + c]));
    pixels.push_back(static_cast<char>(alpha.empty() ? 255 : alpha[i]));
  }
  write_file(path, pixels);
  result["width"] = image.width;
  result["height"] = image.height;
}

// The order of leaf_from_photo: outline, then the fork unless there is a stalk, then the sinus.
json cut_out(const detail::Photo& photo, json result) {
  const detail::Cover cover = photo.alpha.empty() ? detail::cover_of_colours(photo.rgb, std::nullopt)
                                                  : detail::cover_of_alpha(photo.alpha);
  std::vector<detail::PhotoObject> objects = detail::photo_objects(cover.share);
  result["leaves"] = std::count_if(objects.begin(), objects.end(),
                                   [](const auto& object) { return object.no_leaf_reason.empty(); });
  detail::PhotoObject& object = objects.front();
  Outline outline = detail::trace_outline(object, photo.scale);
  if (!cut_stalk(outline).found) {
    if (const auto fork = detail::find_vein_fork(photo.rgb, object)) {
      const Vec2 notch = outline.margin.row(find_petiole(outline.margin).index) / photo.scale;
      if (detail::open_sinus(object, fork->place, {notch.x(), -notch.y()}) > 0.0)
        outline = detail::trace_outline(object, photo.scale);
      result["fork"] = {photo.scale * fork->place.x, photo.scale * fork->place.y};
    }
  }
  result["margin"] = y_down(outline.margin);
  const auto texture = detail::leaf_photo(photo, object);
  result["size"] = texture->image.width;
  result["ridges"] = texture->ridges.strength;
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  json results = json::array();
  for (int k = 2; k < count; ++k) {
    const std::string bytes = read_file(arguments[k], detail::kLargestPicture);
    json result;
    write_pixels(bytes, fmt::format("{}/{}.rgba", arguments[1], k - 2), result);
    results.push_back(cut_out(detail::parse_photo(bytes), result));
  }
  std::cout << results << '\n';
}
