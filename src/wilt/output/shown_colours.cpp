#include "wilt/output/shown_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/output/beside.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that one thread takes

// Of `values` with one entry for all frames or one for each.
template <class Value>
const Value& at_frame(const std::vector<Value>& values, int frame) {
  return values[std::min(static_cast<std::size_t>(frame), values.size() - 1)];
}

Vec3 linear_pixel(const Image& image, int x, int y) {
  static const std::array<double, 256> kLinear = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = decode_srgb(static_cast<double>(i) / 255.0);
    return table;
  }();
  const std::uint8_t* rgb = image.pixel(x, y);
  return {kLinear[rgb[0]], kLinear[rgb[1]], kLinear[rgb[2]]};
}

// The nearest texel's colour at a point of the texture plane.
Vec3 sample(const Image& image, const Vec2& uv) {
  const auto texel = [](double at, int size) {
    return std::clamp(static_cast<int>(std::floor(at * size)), 0, size - 1);
  };
  return linear_pixel(image, texel(uv.x(), image.width), texel(uv.y(), image.height));
}

// As large on both sides as on its larger one: texels are repeated.
Image squared(const Image& image) {
  if (image.width == image.height) return image;
  const int size = std::max(image.width, image.height);
  Image square{size, size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x)
      std::copy_n(image.pixel(x * image.width / size, y * image.height / size), 3, square.pixel(x, y));
  }
  return square;
}

Vec2 centre(int x, int y, int size) {
  return Vec2(x + 0.5, y + 0.5) / size;
}

}  // namespace

ShownColours::ShownColours(const Clip& clip) : clip_(clip) {
  around_ = Points3::Ones(clip.leaf.mesh.num_vertices(), 3);
  if (clip.texture.empty()) return;
  picture_ = squared(decode_image(clip.texture));
  raster_ = uv_raster(clip.leaf.skin, picture_.width);
  around_ = means_around_vertices();
}

int ShownColours::vertex(int face, int corner) const {
  const Skin& skin = clip_.leaf.skin;
  return skin.vertex[static_cast<std::size_t>(skin.faces(face, corner))];
}

// Every texel counts for the corners of its face by its weights; a vertex whose faces cover no texel takes
// the texel that it lies in.
Points3 ShownColours::means_around_vertices() const {
  const Skin& skin = clip_.leaf.skin;
  const int size = picture_.width, vertices = clip_.leaf.mesh.num_vertices();
  Points3 sum = Points3::Zero(vertices, 3);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(vertices);
  for (int i = 0; raster_ && i < size * size; ++i) {
    const int face = raster_->face[static_cast<std::size_t>(i)], x = i % size, y = i / size;
    if (face < 0) continue;
    const Vec3 share = uv_weights(skin, face, centre(x, y, size)).cwiseMax(0.0);
    const Vec3 colour = linear_pixel(picture_, x, y);
    for (int c = 0; c < 3; ++c) {
      sum.row(vertex(face, c)) += share[c] * colour.transpose();
      weight[vertex(face, c)] += share[c];
    }
  }
  for (int s = 0; s < skin.uv.rows(); ++s) {
    const int v = skin.vertex[static_cast<std::size_t>(s)];
    if (weight[v] > 0.0) continue;
    sum.row(v) = sample(picture_, skin.uv.row(s).transpose()).transpose();
    weight[v] = 1.0;
  }
  return sum.array().colwise() / weight.array();
}

Points3 ShownColours::vertex_colours(int frame) const {
  if (clip_.colours.empty()) return Points3::Ones(around_.rows(), 3);
  return at_frame(clip_.colours, frame).cwiseMax(0.0).cwiseMin(1.0);
}

Points3 ShownColours::blade(int frame) const {
  return around_.cwiseProduct(vertex_colours(frame));
}

Vec3 ShownColours::stalk(int frame) const {
  if (clip_.stalk_colours.empty()) return Vec3::Ones();
  return at_frame(clip_.stalk_colours, frame).cwiseMax(0.0).cwiseMin(1.0);
}

std::string ShownColours::texture(int frame) const {
  if (picture_.empty()) return {};
  const Points3 colours = vertex_colours(frame);
  const Vec3 mean = colours.colwise().mean().transpose();
  const SrgbBytes encode;
  const int size = picture_.width;
  Image shown = picture_;
  const auto factor = [&](int x, int y) -> Vec3 {
    if (!raster_) return mean;
    const int face = raster_->face[static_cast<std::size_t>(y) * size + x];
    if (face < 0) return mean;  // bled over below
    const Vec3 share = uv_weights(clip_.leaf.skin, face, centre(x, y, size));
    return share[0] * colours.row(vertex(face, 0)) + share[1] * colours.row(vertex(face, 1)) +
           share[2] * colours.row(vertex(face, 2));
  };
  parallel_for(size, kBand, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3 linear = linear_pixel(picture_, x, y).cwiseProduct(factor(x, y));
        for (int c = 0; c < 3; ++c) shown.pixel(x, y)[c] = encode(linear[c]);
      }
    }
  });
  if (raster_) bleed(*raster_, shown.rgb);
  return encode_jpeg(shown);
}

std::string write_texture(const std::string& path, const ShownColours& shown, int frame) {
  const std::string bytes = shown.texture(frame);
  if (bytes.empty()) return {};
  const std::string file = beside(path, ".texture.jpg");
  write_file(file, bytes);
  return file;
}

std::string write_normal_map(const std::string& path, const Clip& clip) {
  if (clip.normal_texture.empty()) return {};
  const std::string file = beside(path, is_jpeg(clip.normal_texture) ? ".normal.jpg" : ".normal.png");
  write_file(file, clip.normal_texture);
  return file;
}

}  // namespace wilt
