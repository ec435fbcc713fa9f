#include "wilt/output/glb_builder.hpp"

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace wilt {
namespace {

constexpr std::size_t kRowSize = 3 * sizeof(float);

std::size_t padded(std::size_t size) {
  return (size + 3) / 4 * 4;
}

/// How the rows of a sparse accessor are numbered: with the smallest type that can count `rows`.
struct IndexType {
  int component;
  std::size_t size;

  explicit IndexType(std::size_t rows) {
    if (rows <= 1U << 8) {
      component = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, size = 1;
    } else if (rows <= 1U << 16) {
      component = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, size = 2;
    } else {
      component = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, size = 4;
    }
  }
};

}  // namespace

char* GlbBuilder::at(int view) {
  return binary.data() + model.bufferViews[static_cast<std::size_t>(view)].byteOffset;
}

int GlbBuilder::add_view(std::size_t size, int target) {
  binary.resize(padded(binary.size()), '\0');
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = binary.size();
  view.byteLength = size;
  view.target = target;
  binary.resize(binary.size() + size);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int GlbBuilder::add_view(const void* data, std::size_t size, int target) {
  const int view = add_view(size, target);
  std::memcpy(at(view), data, size);
  return view;
}

int GlbBuilder::add_floats(Eigen::Index rows, Eigen::Index columns, int target) {
  static constexpr std::array<int, 3> kTypes{TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3};
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(static_cast<std::size_t>(rows * columns) * sizeof(float), target);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = kTypes.at(static_cast<std::size_t>(columns) - 1);
  accessor.count = static_cast<std::size_t>(rows);
  return add_accessor(accessor);
}

int GlbBuilder::add_floats(const Floats& values, int target, bool bounds) {
  const int number = add_floats(values.rows(), values.cols(), target);
  fill(number, values, bounds);
  return number;
}

int GlbBuilder::add_indices(const Faces& faces) {
  const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor> indices =
      faces.cast<std::uint32_t>();
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(indices.data(), static_cast<std::size_t>(indices.size()) * 4,
                                 TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = static_cast<std::size_t>(indices.size());
  return add_accessor(accessor);
}

int GlbBuilder::add_accessor(const tinygltf::Accessor& accessor) {
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

void GlbBuilder::fill(int number, const Floats& values, bool bounds) {
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
  std::memcpy(at(accessor.bufferView), values.data(),
              static_cast<std::size_t>(values.size()) * sizeof(float));
  for (int c = 0; bounds && c < values.cols(); ++c) {
    accessor.minValues.push_back(values.col(c).minCoeff());
    accessor.maxValues.push_back(values.col(c).maxCoeff());
  }
}

void GlbBuilder::fill_difference(int number, const Floats& values, bool bounds) {
  fill(number, values, bounds);
  std::vector<std::uint32_t> moved;
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    if ((values.row(row).array() != 0.0F).any()) moved.push_back(static_cast<std::uint32_t>(row));
  if (moved.empty()) moved.push_back(0);  // readers like assimp refuse an accessor without any data
  const IndexType index(static_cast<std::size_t>(values.rows()));
  const std::size_t indices_size = padded(moved.size() * index.size);
  const std::size_t size = indices_size + moved.size() * kRowSize;
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
  tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (size >= view.byteLength) return;

  char* bytes = at(accessor.bufferView);
  std::memset(bytes, 0, indices_size);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    // Both the machine and the format are little-endian: the low bytes come first.
    std::memcpy(bytes + i * index.size, &moved[i], index.size);
    std::memcpy(bytes + indices_size + i * kRowSize, values.row(moved[i]).data(), kRowSize);
  }
  view.byteLength = size;
  view.target = 0;
  accessor.sparse.isSparse = true;
  accessor.sparse.count = static_cast<int>(moved.size());
  accessor.sparse.indices.bufferView = accessor.bufferView;
  accessor.sparse.indices.byteOffset = 0;
  accessor.sparse.indices.componentType = index.component;
  accessor.sparse.values.bufferView = accessor.bufferView;
  accessor.sparse.values.byteOffset = static_cast<int>(indices_size);
  accessor.bufferView = -1;
}

void GlbBuilder::pack() {
  std::size_t end = 0;
  for (tinygltf::BufferView& view : model.bufferViews) {
    end = padded(end);
    std::memmove(binary.data() + end, binary.data() + view.byteOffset, view.byteLength);
    view.byteOffset = end;
    end += view.byteLength;
  }
  binary.resize(end);
}

}  // namespace wilt
