#include "wilt/import/photo_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"

namespace wilt::detail {
namespace {

constexpr int kSmallestSide = 64;

// Big- or little-endian numbers of a TIFF block; 0 beyond its end.
class Tiff {
 public:
  explicit Tiff(std::string_view bytes) : bytes_(bytes), little_(bytes.substr(0, 2) == "II") {}
  unsigned number(std::size_t at, int size) const {
    if (at > bytes_.size() || bytes_.size() - at < static_cast<std::size_t>(size)) return 0;
    unsigned value = 0;
    for (int k = 0; k < size; ++k)
      value = value << 8 | static_cast<unsigned char>(bytes_[at + (little_ ? size - 1 - k : k)]);
    return value;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

// The orientation's place in EXIF: tag 0x0112 of the first directory.
int orientation_of(const Tiff& tiff) {
  const std::size_t directory = tiff.number(4, 4);
  const unsigned entries = tiff.number(directory, 2);
  for (unsigned k = 0; k < entries; ++k) {
    const std::size_t entry = directory + 2 + 12 * std::size_t(k);
    if (tiff.number(entry, 2) != 0x0112) continue;
    const unsigned value = tiff.number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

// As EXIF numbers them: 2, 4, 5 and 7 are mirrored.
template <class Mat>
void turn_upright(Mat& image, int orientation) {
  if (image.empty() || orientation == 1) return;
  if (orientation >= 5) cv::transpose(image, image);
  const bool flip_x = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool flip_y = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  if (flip_x) cv::flip(image, image, 1);
  if (flip_y) cv::flip(image, image, 0);
}

}  // namespace

int exif_orientation(std::string_view jpeg) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(jpeg[i]); };
  std::size_t at = 2;  // behind the start marker; segments follow, each with its length
  while (at + 4 <= jpeg.size() && byte(at) == 0xff && byte(at + 1) != 0xda) {
    const std::size_t length = std::size_t(byte(at + 2)) << 8 | byte(at + 3);
    const std::string_view segment = jpeg.substr(at + 4, length < 2 ? 0 : length - 2);
    if (byte(at + 1) == 0xe1 && segment.substr(0, 6) == std::string_view("Exif\0\0", 6))
      return orientation_of(Tiff(segment.substr(6)));
    at += 2 + length;
  }
  return 1;
}

Photo parse_photo(std::string_view bytes) {
  Image image = decode_image(bytes);
  const std::vector<std::uint8_t> alpha = decode_alpha(bytes);
  Photo photo;
  photo.rgb = cv::Mat(image.height, image.width, CV_8UC3, image.rgb.data()).clone();
  if (!alpha.empty() && *std::min_element(alpha.begin(), alpha.end()) < 250)
    photo.alpha = cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(alpha.data())).clone();
  if (std::min(image.width, image.height) < kSmallestSide)
    throw Error(ErrorCode::input, fmt::format("the photo has {} x {} pixels; a leaf needs {} at least on "
                                              "each side, and some 500 to keep its teeth",
                                              image.width, image.height, kSmallestSide));
  const int orientation = is_jpeg(bytes) ? exif_orientation(bytes) : 1;
  turn_upright(photo.rgb, orientation);
  turn_upright(photo.alpha, orientation);
  const int side = std::max(image.width, image.height);
  if (side <= kWorkingSide) return photo;
  photo.scale = static_cast<double>(side) / kWorkingSide;
  const cv::Size size(static_cast<int>(std::lround(photo.rgb.cols / photo.scale)),
                      static_cast<int>(std::lround(photo.rgb.rows / photo.scale)));
  cv::resize(photo.rgb, photo.rgb, size, 0, 0, cv::INTER_AREA);
  if (!photo.alpha.empty()) cv::resize(photo.alpha, photo.alpha, size, 0, 0, cv::INTER_AREA);
  return photo;
}

cv::Mat1b read_mask(const std::filesystem::path& file, const Photo& photo) {
  Photo picture;
  try {
    picture = parse_photo(read_file(file.string(), kLargestPicture));
  } catch (const Error& error) {
    throw Error(ErrorCode::input, fmt::format("--mask '{}': {}", file.string(), error.what()));
  }
  const double ratio = static_cast<double>(picture.rgb.cols) * photo.rgb.rows /
                       (static_cast<double>(picture.rgb.rows) * photo.rgb.cols);
  if (std::abs(ratio - 1.0) > 0.01)
    throw Error(
        ErrorCode::input,
        fmt::format("--mask '{}' is {} x {} pixels, the photo {} x {}: their shapes must agree",
                    file.string(), picture.rgb.cols, picture.rgb.rows, photo.rgb.cols, photo.rgb.rows));
  cv::Mat1b mask;
  cv::cvtColor(picture.rgb, mask, cv::COLOR_RGB2GRAY);
  cv::resize(mask, mask, photo.rgb.size(), 0, 0, cv::INTER_LINEAR);
  return mask;
}

}  // namespace wilt::detail
