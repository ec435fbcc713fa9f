// The triangles of a mesh file, from repair to leaf, without the library that reads the file.
//
// Bytes: options (bits: 1 coordinates are raw float32 instead of whole numbers from -128 to 127, 2 with
// texture coordinates, 4 a petiole is given, 8 remesh, when there are few faces), the number of vertices,
// their coordinates; then a byte for every corner of a face, modulo the number of vertices.
#include <bit>

#include "fuzz/leaf_checks.hpp"
#include "wilt/import/mesh_leaf.hpp"

namespace {

using namespace wilt;

double coordinate(fuzz::Bytes& bytes, bool raw) {
  if (!raw) return bytes.signed_byte();
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits = bits << 8 | static_cast<std::uint32_t>(bytes.byte());
  return std::bit_cast<float>(bits);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostFaces = 400;
  fuzz::Bytes bytes(data, size);
  const int flags = bytes.byte();
  const int vertices = bytes.byte();
  detail::TriangleSoup soup;
  soup.positions.resize(vertices, 3);
  soup.uv = Points2::Constant(vertices, 2, std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < vertices; ++v) {
    for (int c = 0; c < 3; ++c) soup.positions(v, c) = coordinate(bytes, flags & 1);
    if (flags & 2) soup.uv.row(v) << bytes.byte() / 255.0, bytes.byte() / 255.0;
  }
  ReadOptions options;
  if (flags & 4) options.petiole = Vec2(bytes.signed_byte(), bytes.signed_byte());
  const int faces = vertices == 0 ? 0 : std::min(kMostFaces, static_cast<int>(bytes.left() / 3));
  soup.faces.resize(faces, 3);
  for (int f = 0; f < faces; ++f)
    for (int k = 0; k < 3; ++k) soup.faces(f, k) = bytes.byte() % vertices;
  if ((flags & 8) && faces <= 8) options.vertices = 200;
  if (const auto leaf =
          fuzz::unless_refused([&] { return detail::leaf_from_mesh(soup, "leaf", {}, options, {}); }))
    fuzz::check_leaf(*leaf);
  return 0;
}
