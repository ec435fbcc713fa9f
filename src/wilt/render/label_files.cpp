#include "wilt/render/label_files.hpp"

#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostLevels = 65535.0;
constexpr double kNormalZero = 32768.0, kNormalScale = 32767.0;
constexpr std::array kNames{"leaf", "part", "vein", "water", "depth", "normals"};

// As it is said: left to itself, the encoder makes palettes, and 8 bits of 16 where that loses nothing.
std::string png(const LabelMaps& maps, const std::vector<unsigned char>& bytes, LodePNGColorType colours,
                unsigned bits) {
  lodepng::State state;
  state.encoder.auto_convert = 0;
  for (LodePNGColorMode* mode : {&state.info_raw, &state.info_png.color})
    mode->colortype = colours, mode->bitdepth = bits;
  std::vector<unsigned char> encoded;
  const unsigned error = lodepng::encode(encoded, bytes, static_cast<unsigned>(maps.width),
                                         static_cast<unsigned>(maps.height), state);
  if (error != 0)
    throw Error(ErrorCode::output, fmt::format("labels of {} x {} pixels cannot be encoded as PNG: {}",
                                               maps.width, maps.height, lodepng_error_text(error)));
  return {encoded.begin(), encoded.end()};
}

// One byte per pixel.
template <class Level>
std::string png8(const LabelMaps& maps, const Level& level) {
  std::vector<unsigned char> bytes(maps.part.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(level(i));
  return png(maps, bytes, LCT_GREY, 8);
}

// `channels` numbers per pixel, clipped to 16 bits; the high byte first.
template <class Level>
std::string png16(const LabelMaps& maps, std::size_t channels, const Level& level) {
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * channels * maps.part.size());
  for (std::size_t i = 0; i < channels * maps.part.size(); ++i) {
    const auto value = static_cast<unsigned>(std::lround(std::clamp<double>(level(i), 0.0, kMostLevels)));
    bytes.push_back(static_cast<unsigned char>(value >> 8));
    bytes.push_back(static_cast<unsigned char>(value & 0xff));
  }
  return png(maps, bytes, channels == 1 ? LCT_GREY : LCT_RGB, 16);
}

std::string encoded(const LabelMaps& maps, LabelKind kind) {
  const auto seen = [&](std::size_t pixel) { return maps.part[pixel] != 0; };
  switch (kind) {
    case LabelKind::leaf:
      return png8(maps, [&](std::size_t i) { return seen(i) ? 255 : 0; });
    case LabelKind::part:
      return png8(maps, [&](std::size_t i) { return maps.part[i]; });
    case LabelKind::vein:
      return png8(maps, [&](std::size_t i) { return maps.vein[i]; });
    case LabelKind::water:
      return png16(maps, 1, [&](std::size_t i) { return kMostLevels * double(maps.water[i]); });
    case LabelKind::depth:
      return png16(maps, 1, [&, unit = depth_unit(maps)](std::size_t i) {
        return seen(i) ? double(maps.depth[i]) / unit : 0.0;
      });
    case LabelKind::normals:
      return png16(maps, 3, [&](std::size_t i) {
        return seen(i / 3) ? kNormalZero + kNormalScale * double(maps.normals.data()[i]) : 0.0;
      });
  }
  WILT_CHECK(false, int(kind));
  return {};
}

// Nearest and farthest of what is seen; 0, 0 for nothing.
std::array<double, 2> depth_range(const LabelMaps& maps) {
  double nearest = 0.0, farthest = 0.0;
  for (const float depth : maps.depth) {
    if (!std::isfinite(depth)) continue;
    nearest = farthest == 0.0 ? double(depth) : std::min(nearest, double(depth));
    farthest = std::max(farthest, double(depth));
  }
  return {nearest, farthest};
}

Json pixel_counts(const LabelMaps& maps) {
  const auto count = [](const std::vector<std::uint8_t>& values, int value) {
    return std::count(values.begin(), values.end(), static_cast<std::uint8_t>(value));
  };
  Json veins = Json::object();
  for (const auto& [order, width] : maps.vein_width) veins[std::to_string(order)] = count(maps.vein, order);
  return {{"blade", count(maps.part, int(Part::blade))},
          {"stalk", count(maps.part, int(Part::stalk))},
          {"veins", std::move(veins)}};
}

double mean_water(const LabelMaps& maps) {
  double sum = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < maps.part.size(); ++i)
    if (maps.part[i] == std::uint8_t(Part::blade)) sum += double(maps.water[i]), ++pixels;
  return pixels > 0.0 ? sum / pixels : 0.0;
}

Json keypoint_json(const Keypoint& point) {
  if (!point.inside) return {0, 0, 0};
  const auto hundredths = [](double value) { return std::round(100.0 * value) / 100.0; };
  return {hundredths(point.x), hundredths(point.y), point.visible ? 2 : 1};
}

Json camera_json(const LabelMaps& maps) {
  const auto vector = [](const Vec3& v) { return Json{v.x(), v.y(), v.z()}; };
  const CameraAxes axes = camera_axes(maps.camera);
  return {{"focal", 0.5 * maps.height / std::tan(0.5 * maps.camera.field_of_view)},
          {"centre", {0.5 * maps.width, 0.5 * maps.height}},
          {"position", vector(maps.camera.eye)},
          {"right", vector(axes.right)},
          {"up", vector(axes.up)},
          {"forward", vector(axes.forward)}};
}

}  // namespace

const char* label_name(LabelKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

const std::vector<LabelKind>& all_label_kinds() {
  static const std::vector<LabelKind> kinds{LabelKind::leaf,  LabelKind::part,  LabelKind::vein,
                                            LabelKind::water, LabelKind::depth, LabelKind::normals};
  return kinds;
}

double depth_unit(const LabelMaps& maps) {
  const double farthest = depth_range(maps)[1];
  for (double per_metre = 1e6;; per_metre /= 10.0)
    for (const double factor : {1.0, 2.0, 5.0})
      if (farthest <= kMostLevels * (factor / per_metre)) return factor / per_metre;
}

std::vector<std::string> write_label_maps(const std::string& stem, const LabelMaps& maps,
                                          const std::vector<LabelKind>& kinds) {
  std::vector<std::string> files;
  for (const LabelKind kind : kinds) {
    files.push_back(fmt::format("{}.{}.png", stem, label_name(kind)));
    write_file(files.back(), encoded(maps, kind));
  }
  return files;
}

std::string label_json(const LabelMaps& maps) {
  Json tips = Json::array();
  for (const Keypoint& tip : maps.tips) tips.push_back(keypoint_json(tip));
  Json widths = Json::object();
  for (const auto& [order, width] : maps.vein_width) widths[std::to_string(order)] = width;
  const auto one = [](const std::vector<Keypoint>& points, int index) {
    const bool there = index >= 0 && index < static_cast<int>(points.size());
    return there ? keypoint_json(points[static_cast<std::size_t>(index)]) : Json();
  };
  const Json json = {{"width", maps.width},
                     {"height", maps.height},
                     {"box", maps.box},
                     {"area", maps.area},
                     {"pixels", pixel_counts(maps)},
                     {"vein_width", std::move(widths)},
                     {"water", mean_water(maps)},
                     {"depth_unit", depth_unit(maps)},
                     {"depth", depth_range(maps)},
                     {"base", one(maps.base, 0)},
                     {"apex", one(maps.tips, maps.apex)},
                     {"tips", std::move(tips)},
                     {"camera", camera_json(maps)}};
  return json.dump();
}

}  // namespace wilt
