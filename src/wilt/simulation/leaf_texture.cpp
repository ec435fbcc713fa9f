#include "wilt/simulation/leaf_texture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/hash.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that are painted by one thread

// Half widths of veins where they begin, in units of the square root of the blade's
// area; they taper to a share of it.
constexpr double kPrimaryRadius = 0.0082, kSecondaryRadius = 0.0045, kTaper = 0.3;

// A piece of a vein in the texture plane.
struct Stroke {
  Vec2 a, b;
  double radius_a, radius_b;  // in the unit of uv
  double strength;
};

// Texture lengths per metre on a face at rest.
double uv_scale(const Leaf& leaf, int face) {
  std::array<Vec3, 3> p;
  std::array<Vec2, 3> q;
  for (int c = 0; c < 3; ++c) {
    const int s = leaf.skin.faces(face, c);
    p[c] = leaf.positions.row(leaf.skin.vertex[static_cast<std::size_t>(s)]).transpose();
    q[c] = leaf.skin.uv.row(s).transpose();
  }
  const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  const Vec2 u = q[1] - q[0], v = q[2] - q[0];
  return area > 0.0 ? std::sqrt(std::abs(u.x() * v.y() - u.y() * v.x()) / area) : 0.0;
}

Vec2 uv_at(const Skin& skin, const SurfacePoint& point) {
  Vec2 uv = Vec2::Zero();
  for (int c = 0; c < 3; ++c)
    uv += point.barycentric[c] * skin.uv.row(skin.faces(static_cast<int>(point.face), c)).transpose();
  return uv;
}

void add_strokes(const Leaf& leaf, const Vein& vein, double size, double texel,
                 std::vector<Stroke>& strokes) {
  const double base = size * (vein.order == 1 ? kPrimaryRadius : kSecondaryRadius);
  const double strength = vein.order == 1 ? 1.0 : 0.8;
  const auto& points = vein.path.points;
  double gone = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const FaceId face = common_face(leaf.mesh, points[i], points[i + 1]);
    if (!face.valid()) continue;
    const Vec3 from = position(leaf.mesh, leaf.positions, points[i]),
               to = position(leaf.mesh, leaf.positions, points[i + 1]);
    const auto radius = [&](double along) {
      const double taper = 1.0 - (1.0 - kTaper) * std::min(along / std::max(vein.path.length, 1e-12), 1.0);
      return std::max(base * taper * uv_scale(leaf, static_cast<int>(face)), texel);
    };
    const double next = gone + (to - from).norm();
    strokes.push_back({uv_at(leaf.skin, in_face(leaf.mesh, points[i], face)),
                       uv_at(leaf.skin, in_face(leaf.mesh, points[i + 1], face)), radius(gone), radius(next),
                       strength});
    gone = next;
  }
}

// A necrotic spot at `p` (leaf lengths): 1 inside, 0 outside; the older the tissue, the more there are.
double spot(const Vec2& p, double age, std::uint64_t seed) {
  constexpr double kCells = 34.0, kMost = 0.16;
  const Vec2 q = p * kCells;
  const double i = std::floor(q.x()), j = std::floor(q.y());
  const std::uint64_t hash = mix_hash(mix_hash(seed, static_cast<std::uint64_t>(std::int64_t(i))),
                                      static_cast<std::uint64_t>(std::int64_t(j)));
  if (hash_uniform(hash) > kMost * std::min(age, 1.0)) return 0.0;
  const Vec2 centre(i + 0.3 + 0.4 * hash_uniform(mix_hash(hash, 1)),
                    j + 0.3 + 0.4 * hash_uniform(mix_hash(hash, 2)));
  const double size = hash_uniform(mix_hash(hash, 3)), radius = 0.06 + 0.2 * size * size * size;
  const double ragged = 1.0 + 0.35 * value_noise(p * 260.0, seed).value;
  return std::clamp(2.5 * (1.0 - (q - centre).norm() / (radius * ragged)), 0.0, 1.0);
}

class Painter {
 public:
  Painter(const Leaf& leaf, const Venation& venation, const SenescencePattern& pattern,
          const TissueColours& colours, const Eigen::VectorXd& dryness, const Vec3& gain,
          const UvRaster& raster)
      : leaf_(leaf),
        pattern_(pattern),
        dryness_(dryness),
        gain_(gain),
        raster_(raster),
        colours_(colours),
        length_(leaf_length(leaf)),
        seed_(mix_hash(leaf.seed, 77)) {
    const double size = std::sqrt(surface_area(leaf.mesh, leaf.positions));
    for (const Vein& vein : venation.veins) add_strokes(leaf, vein, size, 0.7 / raster.size, strokes_);
  }

  void paint(int first, int last, std::vector<std::uint8_t>& rgb) const {
    const std::vector<float> veins = vein_heights(first, last);
    for (int y = first; y <= last; ++y) {
      for (int x = 0; x < raster_.size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * raster_.size + x;
        if (raster_.face[i] < 0) continue;
        const double vein = veins[static_cast<std::size_t>(y - first) * raster_.size + x];
        const Vec3 linear = colour(raster_.face[i], centre(x, y), vein).cwiseProduct(gain_);
        for (int c = 0; c < 3; ++c)
          rgb[3 * i + c] =
              static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(std::clamp(linear[c], 0.0, 1.0))));
      }
    }
  }

 private:
  Vec2 centre(int x, int y) const { return {(x + 0.5) / raster_.size, (y + 0.5) / raster_.size}; }

  // Heights of the veins' rounded profiles on rows first..last.
  std::vector<float> vein_heights(int first, int last) const {
    const int size = raster_.size;
    std::vector<float> heights(static_cast<std::size_t>(last - first + 1) * size, 0.0F);
    for (const Stroke& stroke : strokes_) {
      const double reach = std::max(stroke.radius_a, stroke.radius_b);
      const auto texel = [size](double uv) { return static_cast<int>(std::floor(uv * size)); };
      const int top = std::max(first, texel(std::min(stroke.a.y(), stroke.b.y()) - reach));
      const int bottom = std::min(last, texel(std::max(stroke.a.y(), stroke.b.y()) + reach));
      const int left = std::max(0, texel(std::min(stroke.a.x(), stroke.b.x()) - reach));
      const int right = std::min(size - 1, texel(std::max(stroke.a.x(), stroke.b.x()) + reach));
      const Vec2 along = stroke.b - stroke.a;
      for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
          const Vec2 p = centre(x, y) - stroke.a;
          const double t = std::clamp(p.dot(along) / std::max(along.squaredNorm(), 1e-30), 0.0, 1.0);
          const double radius = stroke.radius_a + t * (stroke.radius_b - stroke.radius_a);
          const double d = (p - t * along).norm() / radius;
          if (d >= 1.0) continue;
          float& height = heights[static_cast<std::size_t>(y - first) * size + x];
          height = std::max(height, static_cast<float>(stroke.strength * (1.0 - d * d) * (1.0 - d * d)));
        }
      }
    }
    return heights;
  }

  // The blade's colour at a point of a face whose main veins have height `vein` there.
  Vec3 colour(int face, const Vec2& uv, double vein) const {
    const Vec3 weights = uv_weights(leaf_.skin, face, uv);
    Vec2 p = Vec2::Zero();
    double dryness = 0.0, ahead = 0.0, redness = 0.0, margin = 0.0;
    for (int c = 0; c < 3; ++c) {
      const int v = leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(face, c))];
      p += weights[c] * leaf_.positions.row(v).head<2>().transpose() / length_;
      dryness += weights[c] * dryness_[v];
      ahead += weights[c] * pattern_.ahead[v];
      redness += weights[c] * pattern_.redness[v];
      margin += weights[c] * pattern_.margin_distance[v] / length_;
    }
    const FineNetwork network = fine_network(p, leaf_.seed);
    const auto noise = [&](double frequency, std::uint64_t purpose) {
      return value_noise(p * frequency, mix_hash(seed_, purpose)).value;
    };
    const double blotch = noise(13.0, 1), mottle = noise(47.0, 2), grain = noise(210.0, 3);
    const double fine = std::max({network.tertiary, 0.6 * network.quaternary, 0.3 * network.areole});
    const double rim = std::exp(-std::pow(margin / 0.006, 2.0));
    TissueState state;
    state.age = tissue_age(dryness, ahead) +
                dryness * (0.07 * blotch + 0.06 * mottle + 0.03 * grain - 0.035 * fine + 0.30 * rim);
    state.age += (1.38 - state.age) * 0.8 * spot(p, state.age, mix_hash(seed_, 4));
    state.redness = redness + 0.25 * mottle + 0.1 * blotch;
    state.vein = std::max(vein, 0.28 * fine);
    return (1.0 + 0.05 * mottle + 0.05 * grain + 0.03 * blotch) * colours_(state);
  }

  const Leaf& leaf_;
  const SenescencePattern& pattern_;
  const Eigen::VectorXd& dryness_;
  Vec3 gain_;
  const UvRaster& raster_;
  const TissueColours& colours_;
  double length_;
  std::uint64_t seed_;
  std::vector<Stroke> strokes_;
};

}  // namespace

LeafTexture leaf_texture(const Leaf& leaf, const Venation& venation, const SenescencePattern& pattern,
                         const TissueColours& colours, const Eigen::VectorXd& dryness, const Vec3& gain,
                         int size) {
  if (size == 0) return {};
  const std::optional<UvRaster> raster = uv_raster(leaf.skin, size);
  if (!raster) return {};
  const Painter painter(leaf, venation, pattern, colours, dryness, gain, *raster);
  LeafTexture texture{size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
  parallel_for((size + kBand - 1) / kBand, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band)
      painter.paint(band * kBand, std::min(size, (band + 1) * kBand) - 1, texture.rgb);
  });
  bleed(*raster, texture.rgb);
  return texture;
}

}  // namespace wilt
