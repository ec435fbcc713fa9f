// The veins that are finer than a mesh: tertiary cells, the smaller ones within, areoles. Sixteen points at a
// time; functions that call these are compiled with WILT_CLONES.
#pragma once

#include <cstdint>

#include "wilt/core/hash.hpp"
#include "wilt/core/simd.hpp"

namespace wilt {

/// Points of the plane.
struct alignas(64) Place16 {
  Float16 x, y;
};

WILT_INLINE Float16 clamped(Float16 v, float low, float high) {
  return simd::larger(simd::smaller(v, Float16{} + high), Float16{} + low);
}

/// The next whole number below.
WILT_INLINE Int16 floor_of(Float16 v) {
  const Int16 cut = __builtin_convertvector(v, Int16);
  return cut + (__builtin_convertvector(cut, Float16) > v);  // true is -1
}

/// Random words that depend on a square (i, j) of the unit lattice and a seed alone.
struct alignas(64) Lattice16 {
  Word16 key;

  WILT_INLINE Lattice16(Int16 i, Int16 j, std::uint64_t seed)
      : key(__builtin_convertvector(i, Word16) * kRight + __builtin_convertvector(j, Word16) * kUp +
            static_cast<unsigned>(seed)) {}

  /// Of the square (i + right, j + up). The finaliser is a 32-bit one found by search (Wellons 2018).
  WILT_INLINE Word16 word(int right, int up) const {
    Word16 h = key + (static_cast<unsigned>(right) * kRight + static_cast<unsigned>(up) * kUp);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
  }

 private:
  static constexpr unsigned kRight = 0x9e3779b1u, kUp = 0x85ebca77u;
};

/// A word as a number in [-1, 1].
WILT_INLINE Float16 signed_unit(Word16 word) {
  return __builtin_convertvector(__builtin_convertvector(word, Int16), Float16) * 0x1p-31f;
}

/// A word as a number in [0, 1], by its bits from `shift` on, sixteen of them.
WILT_INLINE Float16 unit(Word16 word, int shift) {
  return __builtin_convertvector(__builtin_convertvector((word >> shift) & 0xffffu, Int16), Float16) *
         0x1p-16f;
}

/// Smooth noise in the plane: cubic between random values in [-1, 1] on the integers.
WILT_INLINE Float16 value_noise(const Place16& p, std::uint64_t seed) {
  const Int16 i = floor_of(p.x), j = floor_of(p.y);
  const Float16 x = p.x - __builtin_convertvector(i, Float16), y = p.y - __builtin_convertvector(j, Float16);
  const Float16 s = x * x * (3.0f - 2.0f * x), t = y * y * (3.0f - 2.0f * y);
  const Lattice16 lattice(i, j, seed);
  const Float16 v00 = signed_unit(lattice.word(0, 0)), v10 = signed_unit(lattice.word(1, 0)),
                v01 = signed_unit(lattice.word(0, 1)), v11 = signed_unit(lattice.word(1, 1));
  const Float16 bottom = v00 + s * (v10 - v00), top = v01 + s * (v11 - v01);
  return bottom + t * (top - bottom);
}

/// Distance to the nearest wall between the cells of random points, one in each unit square (Worley 1996): to
/// the line half-way between the two nearest points.
WILT_INLINE Float16 wall_distance(const Place16& p, std::uint64_t seed) {
  const Int16 i = floor_of(p.x), j = floor_of(p.y);
  const Float16 x = p.x - __builtin_convertvector(i, Float16), y = p.y - __builtin_convertvector(j, Float16);
  const Lattice16 lattice(i, j, seed);
  Float16 first = Float16{} + 1e9f, second = first;  // squared distances, of points seen from p
  Place16 nearest{first, first}, other{first, first};
  for (int up = -1; up <= 1; ++up) {
    for (int right = -1; right <= 1; ++right) {
      const Word16 word = lattice.word(right, up);
      const Place16 site{unit(word, 0) + float(right) - x, unit(word, 16) + float(up) - y};
      const Float16 distance = site.x * site.x + site.y * site.y;
      const Int16 is_first = distance < first, is_second = distance < second;
      other.x = is_first ? nearest.x : is_second ? site.x : other.x;
      other.y = is_first ? nearest.y : is_second ? site.y : other.y;
      second = is_first ? first : is_second ? distance : second;
      nearest.x = is_first ? site.x : nearest.x;
      nearest.y = is_first ? site.y : nearest.y;
      first = is_first ? distance : first;
    }
  }
  const Float16 across_x = other.x - nearest.x, across_y = other.y - nearest.y;
  return 0.5f * (second - first) / simd::sqrt(across_x * across_x + across_y * across_y);
}

/// The network at points. Heights are 1 on a vein's axis and 0 in the tissue.
struct alignas(64) FineNetwork16 {
  Float16 tertiary, quaternary, areole;
  Float16 within;  ///< distance to the nearest tertiary vein, in sizes of a tertiary cell
};

/// The network at `p`, x and y of the blade at rest in units of the leaf's length. Cells of about 1/22, 1/60
/// and 1/150 of the length; the finer veins fade in places, as veinlets end freely. A drawing with the looks
/// of a reticulate venation, not a model of its growth. Depends on position and seed alone.
WILT_INLINE FineNetwork16 fine_network(const Place16& p, std::uint64_t seed) {
  const auto noise = [seed](const Place16& q, float frequency, std::uint64_t purpose)
      __attribute__((always_inline)) {
    return value_noise({q.x * frequency, q.y * frequency}, mix_hash(seed, purpose));
  };
  // Bent at two sizes, so that the walls are no straight lines.
  const auto bent = [&](const Place16& q, float frequency, float reach, std::uint64_t purpose)
                        __attribute__((always_inline))
                            ->Place16 {
    return {q.x + reach * noise(p, frequency, purpose), q.y + reach * noise(p, frequency, purpose + 1)};
  };
  const auto wall = [seed](const Place16& q, float frequency, std::uint64_t purpose)
      __attribute__((always_inline)) {
    return wall_distance({q.x * frequency, q.y * frequency}, mix_hash(seed, purpose));
  };
  const auto ridge = [](Float16 distance, float width) __attribute__((always_inline)) {
    const Float16 x = simd::smaller(distance / width, Float16{} + 1.0f), y = 1.0f - x * x;
    return y * y;
  };
  const Place16 coarse = bent(p, 31.0f, 0.006f, 11), fine = bent(coarse, 110.0f, 0.0012f, 21);
  const Float16 fade = clamped(1.2f + noise(p, 80.0f, 31), 0.3f, 1.0f);
  FineNetwork16 network;
  network.within = wall(coarse, 22.0f, 3);
  network.tertiary = ridge(network.within, 0.15f);
  network.quaternary = fade * ridge(wall(fine, 60.0f, 4), 0.20f);
  network.areole = fade * fade * ridge(wall(fine, 150.0f, 5), 0.26f);
  return network;
}

}  // namespace wilt
