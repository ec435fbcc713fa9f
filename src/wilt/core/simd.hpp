// Eight doubles at a time, in functions that are compiled once per class of processor.
//
// The lanes are the compiler's own vectors (GCC and Clang): one source for AVX-512, AVX2, SSE2, NEON and
// WebAssembly, with the same width, the same order of operations and no contraction everywhere, so the
// results are the same bytes on all of them. std::experimental::simd and xsimd do not reach WebAssembly from
// Debian, and loops left to the vectoriser gather three numbers of eight vertices eight times slower than a
// transpose.
#pragma once

#include <cmath>
#include <cstring>

/// Before a function: its body is compiled for AVX-512, for AVX2 and for any processor, and the program takes
/// the best that it finds when it starts. What it calls must be inlined (WILT_INLINE), or it is compiled for
/// any processor only. Sanitizers cannot run the choice at start-up: one version there.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WILT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WILT_CLONES
#endif
#define WILT_INLINE inline __attribute__((always_inline))

namespace wilt {

/// + - * / act lane by lane, also with one number on either side; a comparison gives a Mask8.
using Double8 = double __attribute__((vector_size(64)));
using Mask8 = long __attribute__((vector_size(64)));  ///< all bits of a lane, or none
/// A point and a number that is free to use: points are gathered faster when each is one load.
using Double4 = double __attribute__((vector_size(32)));

/// Sixteen floats, for what ends as eight bits a channel, and as many whole numbers (bits of a random word).
using Float16 = float __attribute__((vector_size(64)));
using Int16 = int __attribute__((vector_size(64)));
using Word16 = unsigned __attribute__((vector_size(64)));

/// Eight points.
struct Point8 {
  Double8 x, y, z;
};

namespace simd {

constexpr int kLanes = 8;

/// `from` need not be aligned.
WILT_INLINE Double8 load(const double* from) {
  Double8 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
WILT_INLINE void store(double* to, Double8 v) {
  std::memcpy(to, &v, sizeof v);
}
WILT_INLINE Float16 load(const float* from) {
  Float16 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
WILT_INLINE void store(float* to, Float16 v) {
  std::memcpy(to, &v, sizeof v);
}

WILT_INLINE Double8 sqrt(Double8 v) {
  Double8 r;
  for (int l = 0; l < kLanes; ++l) r[l] = std::sqrt(v[l]);
  return r;
}

WILT_INLINE Float16 sqrt(Float16 v) {
  Float16 r;
  for (int l = 0; l < 2 * kLanes; ++l) r[l] = std::sqrt(v[l]);
  return r;
}

/// Always added in this order.
WILT_INLINE double sum(Double8 v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// The points of eight indices.
WILT_INLINE Point8 gather(const Double4* points, const int* indices) {
  const auto pair = [&](int k) __attribute__((always_inline)) {  // of lanes k and k + 4
    return __builtin_shufflevector(points[indices[k]], points[indices[k + 4]], 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Double8 a = pair(0), b = pair(1), c = pair(2), d = pair(3);
  // x and z of two lanes, then y: xa xb za zb ...
  const Double8 xz01 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 y01 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Double8 xz23 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 y23 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

}  // namespace simd

}  // namespace wilt
