// A mesh file through the library that reads it, in a process of its own as in `wilt`, and on to a leaf. The
// kind is told by how the bytes begin, so that the corpus is files as they are. The library is not
// instrumented. Where it crashes libFuzzer keeps the input, but that is no finding: the file is refused.
#include <chrono>
#include <string>

#include "fuzz/leaf_checks.hpp"
#include "wilt/import/mesh_leaf.hpp"

namespace {

using namespace wilt;

std::string kind_of(std::string_view bytes) {
  if (bytes.substr(0, 4) == "glTF") return ".glb";
  if (bytes.substr(0, 3) == "ply") return ".ply";
  if (bytes.substr(0, 1) == "{") return ".gltf";
  if (bytes.substr(0, 5) == "solid" || (bytes.size() >= 84 && (bytes.size() - 84) % 50 == 0)) return ".stl";
  return ".obj";
}

// The library may go round in circles; `wilt` waits for two minutes.
Monitor patience() {
  using Clock = std::chrono::steady_clock;
  Monitor monitor;
  monitor.cancelled = [end = Clock::now() + std::chrono::seconds(3)] { return Clock::now() > end; };
  return monitor;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostVertices = 2000;
  const std::string_view bytes = fuzz::text_of(data, size);
  const auto soup =
      fuzz::unless_refused([&] { return detail::read_mesh(bytes, kind_of(bytes), {}, patience()); });
  if (!soup || soup->positions.rows() > kMostVertices) return 0;
  fuzz::require(soup->uv.rows() == soup->positions.rows(), "texture coordinates for every vertex");
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_mesh(*soup, "leaf", {}, {}); });
  return 0;
}
