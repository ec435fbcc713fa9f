// Well-spread sample points that depend on the pixel and the seed alone.
#pragma once

#include <bit>
#include <cstdint>

#include "wilt/core/hash.hpp"
#include "wilt/core/types.hpp"

namespace wilt {

/// The random numbers of one sample of one pixel.
///
/// Each call gives the next pair of dimensions: the points of a pixel's samples in it are a scrambled
/// (0,2)-sequence (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 2020), in an order of its own.
class Sampler {
 public:
  /// `pixel_hash` is mix_hash of the seed and the pixel; 0 <= index < count.
  Sampler(std::uint64_t pixel_hash, std::uint32_t index, std::uint32_t count)
      : hash_(pixel_hash), index_(index), mask_(std::bit_ceil(count) - 1) {}

  Vec2 next();  ///< in [0, 1)^2

 private:
  std::uint64_t hash_;
  std::uint32_t index_, mask_;
  std::uint64_t dimension_ = 0;
};

/// Two unit vectors that are orthogonal to a unit vector and to each other.
struct Frame3 {
  Vec3 s, t, n;
  explicit Frame3(const Vec3& unit_normal);
  Vec3 to_world(const Vec3& local) const { return s * local.x() + t * local.y() + n * local.z(); }
};

/// A unit vector with density cos / pi about z.
Vec3 sample_cosine(const Vec2& u);

/// A unit vector, uniform in solid angle, within `radius` (radians) of z.
Vec3 sample_cap(const Vec2& u, double radius);

/// A half vector of the visible normals of GGX with roughness `alpha`, seen from the unit vector `view`
/// (view.z > 0) (J. Dupuy and A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023).
Vec3 sample_visible_normal(const Vec2& u, const Vec3& view, double alpha);

}  // namespace wilt
