// Bytes as the triangles of a mesh file.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>

#include "fuzz/contract.hpp"
#include "wilt/import/mesh_leaf.hpp"

namespace wilt::fuzz {

struct SurfaceInput {
  detail::TriangleSoup soup;
  ReadOptions options;
};

inline double coordinate(Bytes& bytes, bool raw) {
  if (!raw) return bytes.signed_byte();
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits = bits << 8 | static_cast<std::uint32_t>(bytes.byte());
  return std::bit_cast<float>(bits);
}

/// Options (bits: 1 coordinates are raw float32 instead of whole numbers from -128 to 127, 2 with texture
/// coordinates, 4 a petiole is given), the number of vertices, their coordinates; then a byte for every
/// corner of a face, modulo the number of vertices.
inline SurfaceInput surface_input(Bytes bytes, int most_faces) {
  SurfaceInput input;
  const int flags = bytes.byte(), vertices = bytes.byte();
  detail::TriangleSoup& soup = input.soup;
  soup.positions.resize(vertices, 3);
  soup.uv = Points2::Constant(vertices, 2, std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < vertices; ++v) {
    for (int c = 0; c < 3; ++c) soup.positions(v, c) = coordinate(bytes, flags & 1);
    if (flags & 2) soup.uv.row(v) << bytes.byte() / 255.0, bytes.byte() / 255.0;
  }
  if (flags & 4) input.options.petiole = Vec2(bytes.signed_byte(), bytes.signed_byte());
  const int faces = vertices == 0 ? 0 : std::min(most_faces, static_cast<int>(bytes.left() / 3));
  soup.faces.resize(faces, 3);
  for (int f = 0; f < faces; ++f)
    for (int k = 0; k < 3; ++k) soup.faces(f, k) = bytes.byte() % vertices;
  return input;
}

}  // namespace wilt::fuzz
