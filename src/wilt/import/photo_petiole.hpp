// The petiole of a photographed leaf, where the outline alone does not show it. Inside the import room only.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/import/photo_objects.hpp"

namespace wilt::detail {

/// Where main veins meet.
struct VeinFork {
  cv::Point2d place;           ///< pixels of the photo
  std::vector<double> angles;  ///< radians, directions of the veins that leave it, x to the right, y down
};

/// The place of a palmate leaf from which five veins or more leave; none when the photo shows no such place,
/// or one of a pinnate leaf, whose veins leave both sides of the midrib free.
/// Veins are ridges of lightness, light or dark, or of colour,
/// found by the Hessian at the width of a main vein.
std::optional<VeinFork> find_vein_fork(const cv::Mat3b& rgb, const PhotoObject& object);

/// Cuts the blade open from `petiole` to what lies around it, where basal lobes that overlap hide the sinus:
/// a narrow wedge along a straight line that crosses little tissue and leads more or less `towards` where the
/// outline alone would have the petiole (both in pixels of the photo). Nothing changes when it crosses less
/// than 1.5 % of the object's size. Returns the length that was cut through tissue, pixels.
double open_sinus(PhotoObject& object, const cv::Point2d& petiole, const cv::Point2d& towards);

}  // namespace wilt::detail
