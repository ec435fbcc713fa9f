// What of a photo is not its plain background. Inside the import room only.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "wilt/import/photo_file.hpp"

namespace wilt::detail {

struct Cover {
  cv::Mat1f share;         ///< of every pixel, 0 to 1, that something covers
  double threshold = 0.0;  ///< colour difference that was taken for the edge; 0 with alpha or mask
};

/// From the alpha channel.
Cover cover_of_alpha(const cv::Mat1b& alpha);

/// From the colours, for a background that is plain but may be lit unevenly.
///
/// In CIE Lab, lightness counting half since a shadow changes little else: the background is a cubic in x and
/// y, fitted to what resembles the commonest colour of the photo's rim; what differs from it by more than
/// `threshold` (by default Otsu's) covers it. Along the edge the share of a pixel is its place on the line
/// from the background's colour to the object's colour nearby (alpha matting with both known). Throws
/// Error{input} when there is no plain background. Deterministic.
Cover cover_of_colours(const cv::Mat3b& rgb, std::optional<double> threshold);

}  // namespace wilt::detail
