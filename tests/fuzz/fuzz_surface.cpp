// The triangles of a mesh file, from repair to leaf, without the library that reads the file. The bytes are
// those of surface_input.hpp.
#include "fuzz/leaf_checks.hpp"
#include "fuzz/surface_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  const fuzz::SurfaceInput input = fuzz::surface_input({data, size}, 400);
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_mesh(input.soup, "leaf", input.options, {}); });
  return 0;
}
