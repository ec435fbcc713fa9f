// A photo file as pixels. Inside the import room only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string_view>

namespace wilt::detail {

struct Photo {
  cv::Mat3b rgb;       ///< sRGB, upright, at most kWorkingSide pixels on a side
  cv::Mat1b alpha;     ///< opacity, 255 opaque; empty when the file has none or is opaque throughout
  double scale = 1.0;  ///< pixels of the file, upright, in one of these
};

/// What is larger is scaled down: an outline is found to a fraction of a pixel.
inline constexpr int kWorkingSide = 3000;

/// The pixels of a JPEG or PNG, turned upright by its EXIF orientation (JPEG). Throws Error{input} when it is
/// neither, damaged, or smaller than 64 pixels on a side.
Photo parse_photo(std::string_view bytes);

/// The largest file of a picture that is read, bytes.
inline constexpr std::uint64_t kLargestPicture = std::uint64_t{512} << 20;

/// A mask of the same leaf: white (128 and above, of any channel's mean) is the leaf. It is scaled to the
/// photo; Throws Error{input} when its shape differs from the photo's by more than 1 %.
cv::Mat1b read_mask(const std::filesystem::path& file, const Photo& photo);

/// The EXIF orientation of a JPEG's bytes, 1 (upright) to 8; 1 when it has none.
int exif_orientation(std::string_view jpeg);

}  // namespace wilt::detail
