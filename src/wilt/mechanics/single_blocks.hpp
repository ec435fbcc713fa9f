// Blocks of 3 x 3 numbers in single precision, and their products with vectors (internal).
//
// A block is nine numbers, column by column, and a column is loaded as four: the fourth belongs to what
// follows in memory and is dropped at the end of a row. So an array of blocks has a number of room behind the
// last.
#pragma once

#include <cstddef>
#include <cstring>

#include "wilt/core/simd.hpp"

namespace wilt::detail {

using Single4 = float __attribute__((vector_size(16)));

/// x y z 0.
struct alignas(16) SinglePoint {
  Single4 xyz{};
};

constexpr int kBlockSize = 9;
constexpr int kBlockRoom = 1;

WILT_INLINE Single4 load_column(const float* from) {
  Single4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

WILT_INLINE Single4 without_fourth(Single4 v) {
  return __builtin_shufflevector(v, Single4{}, 0, 1, 2, 4);
}

/// A block in registers; the fourth numbers mean nothing.
struct SingleBlock {
  Single4 columns[3];
};

WILT_INLINE SingleBlock load_block(const float* blocks, int slot) {
  const float* block = blocks + kBlockSize * static_cast<std::ptrdiff_t>(slot);
  return {{load_column(block), load_column(block + 3), load_column(block + 6)}};
}

WILT_INLINE void store_block(float* blocks, int slot, const SingleBlock& block) {
  float* to = blocks + kBlockSize * static_cast<std::ptrdiff_t>(slot);
  for (int k = 0; k < 3; ++k) std::memcpy(to + 3 * k, &block.columns[k], 3 * sizeof(float));
}

/// block += a b^T.
WILT_INLINE void add_outer(SingleBlock& block, Single4 a, Single4 b) {
  for (int k = 0; k < 3; ++k) block.columns[k] += a * b[k];
}

/// Block times x, a number that means nothing in the fourth place.
WILT_INLINE Single4 loose_product(const float* blocks, int slot, Single4 x) {
  const float* block = blocks + kBlockSize * static_cast<std::ptrdiff_t>(slot);
  return load_column(block) * x[0] + load_column(block + 3) * x[1] + load_column(block + 6) * x[2];
}

WILT_INLINE Single4 times(const float* blocks, int slot, Single4 x) {
  return without_fourth(loose_product(blocks, slot, x));
}

/// The sum of the blocks in [begin, end) times the entries of x at their columns.
WILT_INLINE Single4 times_row(const float* blocks, const int* columns, int begin, int end,
                              const SinglePoint* x) {
  Single4 sum{};
  for (int s = begin; s < end; ++s) sum += loose_product(blocks, s, x[columns[s]].xyz);
  return without_fourth(sum);
}

}  // namespace wilt::detail
