// Eight doubles at a time, in functions that are compiled once per class of processor.
//
// The lanes are the compiler's own vectors (GCC and Clang): one source for AVX-512, AVX2, SSE2, NEON and
// WebAssembly, with the same width, the same order of operations and no contraction everywhere, so the
// results are the same bytes on all of them. std::experimental::simd and xsimd do not reach WebAssembly from
// Debian, and the vectoriser does not find the transposes by which points are gathered here.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include "wilt/core/sanitized.hpp"

/// Before a function: its body is compiled for AVX-512, for AVX2 and for any processor, and the program takes
/// the best that it finds when it starts. What it calls must be inlined (WILT_INLINE), or it is compiled for
/// any processor only. Sanitizers cannot run the choice at start-up: one version there.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !WILT_SANITIZED
#define WILT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WILT_CLONES
#endif
#define WILT_INLINE inline __attribute__((always_inline))

namespace wilt {

/// For values in functions, not for arrays: + - * / act lane by lane, also with one number on either side,
/// and so does ?: on a comparison. (Code for different processors disagrees on how a bare vector is aligned
/// in memory.)
using Double8 = double __attribute__((vector_size(64)));
using Double4 = double __attribute__((vector_size(32)));

/// Sixteen floats, for what ends as eight bits a channel, and as many whole numbers (bits of a random word).
using Float16 = float __attribute__((vector_size(64)));
using Int16 = int __attribute__((vector_size(64)));
using Word16 = unsigned __attribute__((vector_size(64)));

/// Eight numbers of an array.
struct alignas(64) Number8 {
  Double8 lanes{};
};

/// Eight points, coordinate by coordinate.
struct alignas(64) Point8 {
  Double8 x{}, y{}, z{};
};
WILT_INLINE Point8 operator+(const Point8& a, const Point8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
WILT_INLINE Point8 operator-(const Point8& a, const Point8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
WILT_INLINE Point8 operator*(const Double8& s, const Point8& a) {
  return {s * a.x, s * a.y, s * a.z};
}
WILT_INLINE Point8 operator*(double s, const Point8& a) {
  return {s * a.x, s * a.y, s * a.z};
}
WILT_INLINE Double8 dot(const Point8& a, const Point8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
WILT_INLINE Point8 cross(const Point8& a, const Point8& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A point of an array that is gathered from, x y z 0: one load each.
struct alignas(32) Point4 {
  Double4 xyz{};
};

namespace simd {

constexpr int kLanes = 8;

/// Added to a squared length, to divide by its root: without it 0/0 where there is no length, with it 0.
constexpr double kTiny = 1e-300;

/// `from` need not be aligned.
WILT_INLINE Double8 load(const double* from) {
  Double8 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
WILT_INLINE Float16 load(const float* from) {
  Float16 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <class Number, class Vector>
WILT_INLINE void store(Number* to, Vector v) {
  std::memcpy(to, &v, sizeof v);
}

template <class Vector>
WILT_INLINE Vector sqrt(Vector v) {
  Vector r;
  for (std::size_t l = 0; l < sizeof(Vector) / sizeof(v[0]); ++l) r[l] = std::sqrt(v[l]);
  return r;
}

template <class Vector>
WILT_INLINE Vector smaller(Vector a, Vector b) {
  return a < b ? a : b;
}
template <class Vector>
WILT_INLINE Vector larger(Vector a, Vector b) {
  return a > b ? a : b;
}

/// Always added in this order.
WILT_INLINE double sum(Double8 v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Eight points as their coordinates; `point(k)` is the k-th.
template <class PointOf>
WILT_INLINE Point8 transpose(const PointOf& point) {
  const Double8 a = __builtin_shufflevector(point(0), point(4), 0, 1, 2, 3, 4, 5, 6, 7);
  const Double8 b = __builtin_shufflevector(point(1), point(5), 0, 1, 2, 3, 4, 5, 6, 7);
  const Double8 c = __builtin_shufflevector(point(2), point(6), 0, 1, 2, 3, 4, 5, 6, 7);
  const Double8 d = __builtin_shufflevector(point(3), point(7), 0, 1, 2, 3, 4, 5, 6, 7);
  // x and z of two lanes, then y: xa xb za zb ...
  const Double8 xz01 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 y01 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Double8 xz23 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 y23 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// The points of eight indices.
WILT_INLINE Point8 gather(const Point4* points, const int* indices) {
  return transpose([&](int k) __attribute__((always_inline)) { return points[indices[k]].xyz; });
}

/// The points of eight indices, three numbers each.
WILT_INLINE Point8 gather(const double* points, const int* indices) {
  return transpose([&](int k) __attribute__((always_inline)) {
    const double* p = points + 3 * static_cast<std::ptrdiff_t>(indices[k]);
    return Double4{p[0], p[1], p[2], 0.0};
  });
}

/// Eight points in a row.
WILT_INLINE Point8 load_points(const Point4* points) {
  return transpose([&](int k) __attribute__((always_inline)) { return points[k].xyz; });
}

/// Writes eight points in a row; the free number of each becomes 0.
WILT_INLINE void store_points(Point4* points, const Point8& p) {
  const Double8 zero{};
  const Double8 xy_even = __builtin_shufflevector(p.x, p.y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 xy_odd = __builtin_shufflevector(p.x, p.y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Double8 z_even = __builtin_shufflevector(p.z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
  const Double8 z_odd = __builtin_shufflevector(p.z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
  points[0].xyz = __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9);
  points[1].xyz = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9);
  points[2].xyz = __builtin_shufflevector(xy_even, z_even, 2, 3, 10, 11);
  points[3].xyz = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 10, 11);
  points[4].xyz = __builtin_shufflevector(xy_even, z_even, 4, 5, 12, 13);
  points[5].xyz = __builtin_shufflevector(xy_odd, z_odd, 4, 5, 12, 13);
  points[6].xyz = __builtin_shufflevector(xy_even, z_even, 6, 7, 14, 15);
  points[7].xyz = __builtin_shufflevector(xy_odd, z_odd, 6, 7, 14, 15);
}

}  // namespace simd

}  // namespace wilt
