// The arrays of a GLB: its binary chunk, and the accessors and views that describe it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "wilt/core/types.hpp"

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace wilt {

using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Fills the binary chunk, and the accessors of a model that describe it. For the sources of this room only.
class GlbBuilder {
 public:
  explicit GlbBuilder(tinygltf::Model& target) : model(target) {}

  tinygltf::Model& model;
  std::string binary;

  /// Number of a new view of `size` bytes, aligned to 4.
  int add_view(std::size_t size, int target);
  int add_view(const void* data, std::size_t size, int target);

  /// Room for #N x (1, 2 or 3) values, which fill() or fill_difference() writes.
  int add_floats(Eigen::Index rows, Eigen::Index columns, int target);
  int add_floats(const Floats& values, int target, bool bounds);
  int add_indices(const Faces& faces);

  /// Writes the values of an accessor; the format asks for bounds of positions and of key times. Of different
  /// accessors on several threads, and so is fill_difference().
  void fill(int accessor, const Floats& values, bool bounds);

  /// The same for #N x 3 values of a morph target: sparse, only the rows that are not zero, where that takes
  /// fewer bytes (glTF 2.0, section 3.6.2.3). Ends in pack().
  void fill_difference(int accessor, const Floats& values, bool bounds);

  /// Closes the gaps that fill_difference() left. Once, at the end.
  void pack();

 private:
  char* at(int view);
  int add_accessor(const tinygltf::Accessor& accessor);
};

}  // namespace wilt
