#include "wilt/import/leaf_in_memory.hpp"

#include <fmt/format.h>

#include <limits>

#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/mesh_leaf.hpp"
#include "wilt/import/reading.hpp"

namespace wilt {
namespace {

void check_indices(const MeshArrays& mesh) {
  const Eigen::Index count = mesh.positions.rows();
  if (mesh.faces.rows() == 0) throw Error(ErrorCode::input, "there is no face; a leaf needs triangles");
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (const int v : {mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)}) {
      if (v < 0 || v >= count)
        throw Error(ErrorCode::input, fmt::format("face {} has vertex {}, but there are {} (counted from 0); "
                                                  "remove the face",
                                                  f, v, count));
    }
  }
  if (mesh.uv.rows() != 0 && mesh.uv.rows() != count)
    throw Error(ErrorCode::input,
                fmt::format("there are {} texture coordinates for {} positions; give one for "
                            "each, or none",
                            mesh.uv.rows(), count));
  if (mesh.petiole && (*mesh.petiole < 0 || *mesh.petiole >= count))
    throw Error(ErrorCode::input, fmt::format("the petiole is position {}, but there are {} (counted from 0)",
                                              *mesh.petiole, count));
}

detail::TriangleSoup soup_of(const MeshArrays& mesh) {
  check_indices(mesh);
  detail::TriangleSoup soup{mesh.positions, mesh.uv, mesh.faces, {}};
  if (mesh.uv.rows() == 0)
    soup.uv.setConstant(mesh.positions.rows(), 2, std::numeric_limits<double>::quiet_NaN());
  if (mesh.petiole) soup.petiole = mesh.positions.row(*mesh.petiole).transpose();
  return soup;
}

}  // namespace

namespace detail {

void check_length(const Leaf& leaf, const std::string& name) {
  const double length = leaf_length(leaf);
  constexpr double kLeast = 1e-15, kMost = 1e15;  // metres
  if (!(length >= kLeast && length <= kMost))
    throw Error(ErrorCode::input,
                fmt::format("'{}': the leaf would be {:.3g} m long; {:g} to {:g} are allowed: mend its scale",
                            name, length, kLeast, kMost));
}

void validate_size_and_petiole(const ReadOptions& options) {
  if (options.vertices && (*options.vertices < 200 || *options.vertices > 1'000'000))
    throw Error(ErrorCode::configuration,
                fmt::format("--vertices {} must be from 200 to 1000000", *options.vertices));
  if (options.petiole && !options.petiole->allFinite())
    throw Error(ErrorCode::configuration, "--petiole must be two finite numbers X,Y");
}

}  // namespace detail

Leaf leaf_from_arrays(const MeshArrays& mesh, const std::string& name, const ReadOptions& options,
                      const Monitor& monitor) {
  detail::validate_size_and_petiole(options);
  Leaf leaf =
      detail::naming(name, [&] { return detail::leaf_from_mesh(soup_of(mesh), name, options, monitor); });
  detail::check_length(leaf, name);
  return leaf;
}

Leaf leaf_from_drawing(DrawnLeaf drawn, const std::string& name, const ReadOptions& options,
                       const Monitor& monitor) {
  detail::validate_size_and_petiole(options);
  Leaf leaf = detail::naming(
      name, [&] { return detail::leaf_from_outline(std::move(drawn), name, options, monitor); });
  detail::check_length(leaf, name);
  return leaf;
}

}  // namespace wilt
