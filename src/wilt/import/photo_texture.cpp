#include "wilt/import/photo_texture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace wilt::detail {
namespace {

constexpr int kLargestSide = 4096;

}  // namespace

cv::Mat3b bled_colours(const cv::Mat3b& rgb, const PhotoObject& object) {
  cv::Mat1b pure, inner;
  pure = object.share >= 0.98f;
  cv::erode(pure, inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  cv::Mat3b colours = rgb(object.box).clone();
  if (cv::countNonZero(inner) == 0) return colours;
  cv::Mat1f distance;
  cv::Mat1i nearest;  // the number of the nearest pure pixel, which has its own number
  cv::distanceTransform(~inner, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec3b> palette(inner.total() + 1);
  for (int y = 0; y < inner.rows; ++y)
    for (int x = 0; x < inner.cols; ++x)
      if (inner(y, x)) palette[static_cast<std::size_t>(nearest(y, x))] = colours(y, x);
  colours.forEach([&](cv::Vec3b& colour, const int* at) {
    if (!inner(at[0], at[1])) colour = palette[static_cast<std::size_t>(nearest(at[0], at[1]))];
  });
  return colours;
}

std::shared_ptr<const LeafPhoto> leaf_photo(const Photo& photo, const PhotoObject& object) {
  const cv::Mat3b colours = bled_colours(photo.rgb, object);
  const int longest = std::max(colours.cols, colours.rows), spare = longest / 64 + 2;
  const int side = longest + 2 * spare;
  const int left = (side - colours.cols) / 2, top = (side - colours.rows) / 2;
  cv::Mat3b square;
  cv::copyMakeBorder(colours, square, top, side - colours.rows - top, left, side - colours.cols - left,
                     cv::BORDER_REPLICATE);
  if (side > kLargestSide) cv::resize(square, square, {kLargestSide, kLargestSide}, 0, 0, cv::INTER_AREA);
  const auto result = std::make_shared<LeafPhoto>();
  result->image = {square.cols, square.rows, {square.data, square.data + 3 * square.total()}};
  result->area.origin = photo.scale * Vec2(object.box.x - left, object.box.y - top);
  result->area.size = Vec2::Constant(photo.scale * side);
  return result;
}

}  // namespace wilt::detail
