// The things in a photo, and which of them are leaves. Inside the import room only.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace wilt::detail {

/// A connected thing of a photo.
struct PhotoObject {
  cv::Rect box;                ///< pixels, two wider than the object where the photo allows it
  cv::Mat1f share;             ///< of each of the box's pixels, 0 to 1, that this object covers
  double area = 0.0;           ///< pixels
  bool cut_off = false;        ///< whether it touches the photo's edge
  std::string no_leaf_reason;  ///< why it is taken for no leaf: "a ruler or a card"; empty for a leaf
};

/// The things that cover at least 1/2000 of the photo, those that may be leaves first, by area; what touches
/// the photo's edge comes behind whole ones of a quarter of its area. No leaves are rectangles (rulers,
/// cards), discs (coins) and lines (tape, strings).
std::vector<PhotoObject> photo_objects(const cv::Mat1f& share);

}  // namespace wilt::detail
