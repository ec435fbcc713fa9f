// Lines in a photo: veins, light or dark, or of another colour. Inside the import room only.
#pragma once

#include <opencv2/core.hpp>

namespace wilt::detail {

struct Ridges {
  cv::Mat1f strength;   ///< contrast of a line through the pixel, 0 to 1, which the strongest tenth share
  cv::Mat1f direction;  ///< radians of the line, 0 to pi, y down
};

/// The clearest ridges of lightness and of both colour axes, inside the mask: eigenvalues of the Hessian at a
/// width of some three pixels (Steger 1998).
Ridges find_ridges(const cv::Mat3f& lab, const cv::Mat1b& inside);

}  // namespace wilt::detail
