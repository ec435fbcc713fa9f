// Hashes: of bytes, and as random numbers that depend on a place alone (no stream, no order).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace wilt {

/// Mixes a value into a hash (the finaliser of splitmix64, S. Vigna 2015).
inline std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t value) {
  std::uint64_t z = hash + 0x9e3779b97f4a7c15ULL * (value + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// A uniform number in [0, 1) from a hash.
inline double hash_uniform(std::uint64_t hash) {
  return double(hash >> 11) * 0x1.0p-53;
}

/// The hash of bytes: FNV-1a, 64 bits (Fowler, Noll and Vo). Not against forgery.
inline std::uint64_t hash_bytes(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 1099511628211ULL;
  }
  return hash;
}

/// hash_bytes of a matrix's or vector's entries, in the order in which it keeps them.
template <class Derived>
std::uint64_t hash_entries(const Eigen::PlainObjectBase<Derived>& matrix) {
  return hash_bytes({reinterpret_cast<const char*>(matrix.data()),
                     sizeof(typename Derived::Scalar) * static_cast<std::size_t>(matrix.size())});
}

}  // namespace wilt
