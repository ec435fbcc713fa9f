// The triangles of a mesh file, from repair to a leaf that is meshed anew with 200 vertices. The bytes are
// those of surface_input.hpp.
#include "fuzz/leaf_checks.hpp"
#include "fuzz/surface_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  fuzz::SurfaceInput input = fuzz::surface_input({data, size}, 60);
  input.options.vertices = 200;
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_mesh(input.soup, "leaf", input.options, {}); });
  return 0;
}
