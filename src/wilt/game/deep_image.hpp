// Pictures of numbers: half floats in EXR, 16 bits in PNG.
#pragma once

#include <Eigen/Core>
#include <string>

namespace wilt {

/// Three numbers a texel; rows from the top.
struct DeepImage {
  int width = 0, height = 0;
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> texels;  ///< #width * height x 3
};

/// OpenEXR with channels R, G, B as half floats (11 significant bits), ZIP compression. Throws Error{output}
/// when a value is beyond their 65504, or when it cannot be encoded.
std::string encode_exr(const DeepImage& image);

/// PNG with 16 bits a channel, for values 0 to 1 (clipped): round(65535 value). Throws Error{output} when it
/// cannot be encoded.
std::string encode_png16(const DeepImage& image);

}  // namespace wilt
