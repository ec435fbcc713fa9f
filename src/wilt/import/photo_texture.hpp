// The pixels of a photographed leaf as a texture. Inside the import room only.
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "wilt/import/photo_file.hpp"
#include "wilt/import/photo_objects.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt::detail {

/// The colours of the object's box, in which every pixel that the object does not cover wholly (share below
/// 0.98, and a rim of one pixel) has the colour of the nearest that it does.
cv::Mat3b bled_colours(const cv::Mat3b& rgb, const PhotoObject& object);

/// The square around the object, with 1/64 to spare on every side, as Leaf::photo: of at most 4096 texels on
/// a side, at the photo's own resolution below that. Outside the photo the rim's colours go on.
std::shared_ptr<const LeafPhoto> leaf_photo(const Photo& photo, const PhotoObject& object);

}  // namespace wilt::detail
