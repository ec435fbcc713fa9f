#include "wilt/venation/secondary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/check.hpp"
#include "wilt/geodesics/trace.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt::detail {
namespace {

constexpr double kFirst = 0.12;      // no secondary vein on this first share of the primary
constexpr double kLast = 0.06;       // nor on this last share
constexpr double kClearance = 0.25;  // between veins, in units of the spacing
constexpr double kShortest = 0.2;    // a shorter vein is left out, in units of the spacing
constexpr double kReach = 0.96;      // share of the way to whatever stops it that a vein covers
constexpr double kCoarse = 0.1;  // between the points that a drawn vein is kept by, in units of the clearance
constexpr int kPasses = 4;       // straight first, then bent over the length found before

/// A place on a primary vein.
struct Origin {
  SurfacePoint point;
  Vec3 tangent = Vec3::Zero();  ///< of the primary, towards its tip
  Vec3 normal = Vec3::Zero();   ///< of the face
};

/// A vein as a polyline in space, with its bounding box.
struct Drawn {
  int parent = -1;
  int side = 0;  ///< 1: left of its primary, -1: right
  std::vector<Vec3> points;
  Eigen::AlignedBox3d box;
};

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

bool within(const Drawn& vein, const Vec3& p, double distance) {
  if (vein.box.exteriorDistance(p) > distance) return false;
  for (std::size_t k = 1; k < vein.points.size(); ++k) {
    if (distance_to_segment(p, vein.points[k - 1], vein.points[k]) < distance) return true;
  }
  return false;
}

class SecondaryVeins {
 public:
  SecondaryVeins(const SurfaceMesh& mesh, const Points3& positions, const Eigen::MatrixXd& to_primary,
                 const SecondaryVeinRule& rule)
      : mesh_(mesh),
        positions_(positions),
        to_primary_(to_primary),
        rule_(rule),
        spacing_(rule.spacing * std::sqrt(surface_area(mesh, positions))) {}

  void grow_from(const SurfacePath& primary, int index) {
    const double end = (1.0 - kLast) * primary.length;
    bool left = true;
    const double step = rule_.alternate ? 0.5 * spacing_ : spacing_;
    for (int k = 0;; ++k) {
      const double s = kFirst * primary.length + k * step;
      if (s > end) break;
      if (left || !rule_.alternate) grow(primary, index, s, 1);
      if (!left || !rule_.alternate) grow(primary, index, s, -1);
      left = !left;
    }
  }

  std::vector<Vein> take() { return std::move(veins_); }

 private:
  /// Left: side = 1, right: side = -1.
  void grow(const SurfacePath& primary, int index, double s, int side) {
    const Origin origin = origin_at(primary, s);
    const double share = s / primary.length;
    const double angle = (1.0 - share) * rule_.angle + share * rule_.angle_tip;
    const Vec3 direction = Eigen::AngleAxisd(side * angle, origin.normal) * origin.tangent;
    // Turns by rule_.curvature over the stretch `arc`, then goes straight.
    const auto trace = [&](double longest, double arc) {
      double farthest = 0.0;
      const auto stop = [&](const SurfacePoint& point) { return crowded(point, index, side, farthest); };
      const auto turn = [&](double at) { return at < arc ? -side * rule_.curvature / arc : 0.0; };
      return trace_straight(mesh_, positions_, origin.point, direction, longest, turn, stop);
    };
    double length = 0.0, arc = 0.0;
    for (int pass = 0; pass < kPasses; ++pass) {
      length = trace(primary.length - s, arc).length;
      if (length < kShortest * spacing_) return;
      arc = length;
    }

    Vein vein;
    vein.order = 2;
    vein.parent = index;
    vein.path = trace(kReach * length, arc);
    remember(vein, side);
    veins_.push_back(std::move(vein));
  }

  Origin origin_at(const SurfacePath& path, double s) const {
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const FaceId face = common_face(mesh_, path.points[k - 1], path.points[k]);
      WILT_CHECK(face.valid(), k, path.points.size());
      const SurfacePoint a = in_face(mesh_, path.points[k - 1], face),
                         b = in_face(mesh_, path.points[k], face);
      const Vec3 along = position(mesh_, positions_, b) - position(mesh_, positions_, a);
      const double length = along.norm();
      const bool last = k + 1 == path.points.size();
      if ((s <= length || last) && length > 0.0) {
        const double t = std::min(s / length, 1.0);
        return {{face, (1.0 - t) * a.barycentric + t * b.barycentric}, along / length, normal(face)};
      }
      s -= length;
    }
    WILT_CHECK(false, s);
    return {};
  }

  Vec3 normal(FaceId face) const {
    const auto [a, b, c] = mesh_.face_vertices(face);
    const Vec3 ab = (positions_.row(b) - positions_.row(a)).transpose();
    const Vec3 ac = (positions_.row(c) - positions_.row(a)).transpose();
    return ab.cross(ac).normalized();
  }

  /// Whether a vein must end before `point`; `farthest` is how far from its primary it has been.
  bool crowded(const SurfacePoint& point, int parent, int side, double& farthest) const {
    const double clearance = kClearance * spacing_;
    const auto corners = mesh_.face_vertices(point.face);
    double own = 0.0, other = std::numeric_limits<double>::infinity();
    for (Eigen::Index vein = 0; vein < to_primary_.rows(); ++vein) {
      double distance = 0.0;
      for (int k = 0; k < 3; ++k) distance += point.barycentric(k) * to_primary_(vein, int(corners[k]));
      if (vein == parent) {
        own = distance;
      } else {
        other = std::min(other, distance);
      }
    }
    farthest = std::max(farthest, own);
    if (other - own < clearance || own < farthest - clearance) return true;
    const Vec3 place = position(mesh_, positions_, point);
    return std::any_of(drawn_.begin(), drawn_.end(), [&](const Drawn& vein) {
      // The veins across their common primary start where this one does.
      return (vein.parent != parent || vein.side == side) && within(vein, place, clearance);
    });
  }

  void remember(const Vein& vein, int side) {
    Drawn drawn;
    drawn.parent = vein.parent;
    drawn.side = side;
    const double apart = kCoarse * kClearance * spacing_;
    for (const SurfacePoint& point : vein.path.points) {
      const Vec3 place = position(mesh_, positions_, point);
      if (!drawn.points.empty() && &point != &vein.path.points.back() &&
          (place - drawn.points.back()).norm() < apart)
        continue;
      drawn.points.push_back(place);
      drawn.box.extend(place);
    }
    drawn_.push_back(std::move(drawn));
  }

  const SurfaceMesh& mesh_;
  const Points3& positions_;
  const Eigen::MatrixXd& to_primary_;
  const SecondaryVeinRule& rule_;
  double spacing_;
  std::vector<Drawn> drawn_;
  std::vector<Vein> veins_;
};

}  // namespace

std::vector<Vein> secondary_veins(const SurfaceMesh& mesh, const Points3& positions,
                                  const std::vector<Vein>& primaries, const Eigen::MatrixXd& to_primary,
                                  const SecondaryVeinRule& rule) {
  SecondaryVeins secondary(mesh, positions, to_primary, rule);
  for (std::size_t i = 0; i < primaries.size(); ++i)
    secondary.grow_from(primaries[i].path, static_cast<int>(i));
  return secondary.take();
}

}  // namespace wilt::detail
