// Values as bytes and back, from one process of this program to another. Inside the import room only.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "wilt/core/check.hpp"

namespace wilt::detail {

/// Appends values; Unpacker gives them back in the same order.
class Packer {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  /// An Eigen matrix whose number of columns is fixed.
  template <class Matrix>
  void matrix(const Matrix& matrix) {
    value(std::int64_t{matrix.rows()});
    bytes_.append(reinterpret_cast<const char*>(matrix.data()),
                  sizeof(typename Matrix::Scalar) * static_cast<std::size_t>(matrix.size()));
  }

  void texts(const std::vector<std::string>& texts) {
    value(texts.size());
    for (const std::string& text : texts) {
      value(text.size());
      bytes_ += text;
    }
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes the values out again; `bytes` must be what a Packer made, and must live as long as this.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T value() {
    T result;
    copy(&result, sizeof result);
    return result;
  }

  template <class Matrix>
  Matrix matrix() {
    Matrix result;
    result.resize(value<std::int64_t>(), result.cols());
    if (result.size() > 0)
      copy(result.data(), sizeof(typename Matrix::Scalar) * static_cast<std::size_t>(result.size()));
    return result;
  }

  std::vector<std::string> texts() {
    std::vector<std::string> result(value<std::size_t>());
    for (std::string& text : result) {
      text.resize(value<std::size_t>());
      copy(text.data(), text.size());
    }
    return result;
  }

 private:
  void copy(void* to, std::size_t size) {
    WILT_CHECK(size <= rest_.size(), size, rest_.size());
    std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  std::string_view rest_;
};

}  // namespace wilt::detail
