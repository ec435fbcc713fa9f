// A GLB that wilt is to read back. The bytes are one, or (so that a change of length needs no change of the
// header) its JSON, a zero byte and its binary chunk.
#include <algorithm>
#include <string>

#include "fuzz/contract.hpp"
#include "wilt/output/glb_container.hpp"
#include "wilt/output/gltf.hpp"

namespace {

using namespace wilt;
using fuzz::require;

void check_mesh(const GlbMesh& mesh, std::size_t frames) {
  const Eigen::Index rows = mesh.frames.at(0).rows();
  require(mesh.frames.size() == frames && mesh.normals.size() == frames,
          "a shape and normals for every frame");
  require(mesh.colours.size() <= 1 || mesh.colours.size() == frames,
          "colours: none, one or one for every frame");
  for (const auto* list : {&mesh.frames, &mesh.normals, &mesh.colours})
    for (const Points3& points : *list)
      require(points.rows() == rows && points.allFinite(), "finite rows, one for every vertex");
  require(mesh.uv.rows() == 0 || (mesh.uv.rows() == rows && mesh.uv.allFinite()),
          "finite texture coordinates");
  require(mesh.water.size() == 0 || (mesh.water.size() == rows && mesh.water.allFinite()), "finite water");
  require(mesh.faces.rows() > 0 && mesh.faces.minCoeff() >= 0 && mesh.faces.maxCoeff() < rows,
          "faces have vertices");
}

void check_file(const GlbFile& file) {
  const std::size_t frames = file.times.size();
  require(!file.meshes.empty() && frames > 0, "there is something to show");
  require(file.iterations.size() == frames && file.dryness.size() == frames, "figures for every frame");
  for (const GlbMesh& mesh : file.meshes) check_mesh(mesh, frames);
  for (const GlbVein& vein : file.veins) {
    require(vein.positions.allFinite() && vein.barycentric.allFinite(), "finite veins");
    for (const int face : vein.faces)
      require(face >= 0 && face < file.meshes[0].faces.rows(), "veins lie in faces");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(fuzz::text_of(data, size));
  if (const std::size_t end = bytes.find('\0'); bytes.rfind("glTF", 0) != 0 && end != bytes.npos)
    bytes = join_glb(bytes.substr(0, end), bytes.substr(end + 1));
  if (const auto file = fuzz::unless_refused([&] { return parse_glb(bytes, "leaf.glb"); })) check_file(*file);
  return 0;
}
