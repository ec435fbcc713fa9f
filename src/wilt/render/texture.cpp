#include "wilt/render/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/render/tone.hpp"

namespace wilt {

Texture::Texture(const Image& image, Kind kind) {
  if (image.rgb.empty()) return;
  std::array<float, 256> value{};
  for (int i = 0; i < 256; ++i)
    value[std::size_t(i)] = float(kind == Kind::colour ? decode_srgb(i / 255.0) : i / 127.5 - 1.0);
  Level level{image.width, image.height, {}};
  level.pixels.reserve(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    level.pixels.emplace_back(value[image.rgb[i]], value[image.rgb[i + 1]], value[image.rgb[i + 2]]);
  while (true) {
    const Level& fine = levels_.emplace_back(std::move(level));
    if (fine.width == 1 && fine.height == 1) return;
    level = {std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), {}};
    level.pixels.reserve(std::size_t(level.width) * std::size_t(level.height));
    const auto pixel = [&fine](int x, int y) -> const Eigen::Vector3f& {
      return fine.pixels[std::size_t(std::min(y, fine.height - 1)) * std::size_t(fine.width) +
                         std::size_t(std::min(x, fine.width - 1))];
    };
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x)
        level.pixels.push_back(0.25F * (pixel(2 * x, 2 * y) + pixel(2 * x + 1, 2 * y) +
                                        pixel(2 * x, 2 * y + 1) + pixel(2 * x + 1, 2 * y + 1)));
  }
}

double Texture::size() const {
  return empty() ? 0.0 : std::sqrt(double(levels_[0].width) * levels_[0].height);
}

Vec3 Texture::bilinear(const Level& level, const Vec2& uv) {
  const double x = std::clamp(uv.x() * level.width - 0.5, 0.0, level.width - 1.0);
  const double y = std::clamp(uv.y() * level.height - 0.5, 0.0, level.height - 1.0);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, level.width - 1),
            y1 = std::min(y0 + 1, level.height - 1);
  const auto pixel = [&level](int i, int j) -> const Eigen::Vector3f& {
    return level.pixels[std::size_t(j) * std::size_t(level.width) + std::size_t(i)];
  };
  const float fx = float(x - x0), fy = float(y - y0);
  const Eigen::Vector3f top = (1.0F - fx) * pixel(x0, y0) + fx * pixel(x1, y0);
  const Eigen::Vector3f bottom = (1.0F - fx) * pixel(x0, y1) + fx * pixel(x1, y1);
  return ((1.0F - fy) * top + fy * bottom).cast<double>();
}

Vec3 Texture::at(const Vec2& uv, double footprint) const {
  const double level = std::log2(std::max(footprint * size(), 1.0));
  const int coarsest = static_cast<int>(levels_.size()) - 1;
  const int fine = std::min(int(level), coarsest);
  const double between = level - fine;
  const Vec3 value = bilinear(levels_[std::size_t(fine)], uv);
  if (fine == coarsest || between == 0.0) return value;
  return (1.0 - between) * value + between * bilinear(levels_[std::size_t(fine) + 1], uv);
}

}  // namespace wilt
