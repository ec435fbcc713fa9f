#include "wilt/simulation/vein_strokes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

// Half widths of veins where they begin, in units of the square root of the blade's area; they taper to a
// share of it.
constexpr double kPrimaryRadius = 0.0082, kSecondaryRadius = 0.0045, kTaper = 0.3;

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

}  // namespace

VeinStrokes::VeinStrokes(const Leaf& leaf, const Venation& venation, int size) : size_(size) {
  const double blade = std::sqrt(surface_area(leaf.mesh, leaf.positions));
  for (const Vein& vein : venation.veins) add(leaf, vein, blade);
}

void VeinStrokes::add(const Leaf& leaf, const Vein& vein, double blade) {
  const double base = blade * (vein.order == 1 ? kPrimaryRadius : kSecondaryRadius);
  const double thinnest = 0.7 / size_;
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
      return std::max(base * taper * uv_scale(leaf, static_cast<int>(face)), thinnest);
    };
    const double next = gone + (to - from).norm();
    strokes_.push_back({uv_at(leaf.skin, in_face(leaf.mesh, points[i], face)),
                        uv_at(leaf.skin, in_face(leaf.mesh, points[i + 1], face)), radius(gone), radius(next),
                        strength});
    gone = next;
  }
}

std::vector<float> VeinStrokes::heights(int first, int last) const {
  std::vector<float> heights(static_cast<std::size_t>(last - first + 1) * size_, 0.0F);
  for (const Stroke& stroke : strokes_) {
    const double reach = std::max(stroke.radius_a, stroke.radius_b);
    const auto texel = [this](double uv) { return static_cast<int>(std::floor(uv * size_)); };
    const int top = std::max(first, texel(std::min(stroke.a.y(), stroke.b.y()) - reach));
    const int bottom = std::min(last, texel(std::max(stroke.a.y(), stroke.b.y()) + reach));
    const int left = std::max(0, texel(std::min(stroke.a.x(), stroke.b.x()) - reach));
    const int right = std::min(size_ - 1, texel(std::max(stroke.a.x(), stroke.b.x()) + reach));
    const Vec2 along = stroke.b - stroke.a;
    const double per_length = 1.0 / std::max(along.squaredNorm(), 1e-30);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const Vec2 p = texel_centre(x, y, size_) - stroke.a;
        const double t = std::clamp(p.dot(along) * per_length, 0.0, 1.0);
        const double radius = stroke.radius_a + t * (stroke.radius_b - stroke.radius_a);
        const double square = (p - t * along).squaredNorm() / (radius * radius);
        if (square >= 1.0) continue;
        float& height = heights[static_cast<std::size_t>(y - first) * size_ + x];
        height = std::max(height, static_cast<float>(stroke.strength * (1.0 - square) * (1.0 - square)));
      }
    }
  }
  return heights;
}

}  // namespace wilt
