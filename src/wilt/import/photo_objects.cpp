#include "wilt/import/photo_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace wilt::detail {
namespace {

constexpr double kSmallest = 1.0 / 2000.0;  // of the photo
constexpr double kRectangle = 0.92;         // area over that of the smallest rectangle around it
constexpr double kDisc = 0.975;             // area over that of its smallest circle
constexpr double kThinnest = 0.02;          // area of the largest disc inside over its own
constexpr double kSpeck = 0.05;             // smaller than this share of the largest is no leaf beside it,
constexpr double kEdgeThing = 0.2;          // nor is this at the edge of the photo
constexpr double kWholeWins = 0.25;  // a whole leaf goes before one that is cut off and not 1 / this larger

std::string why_no_leaf(const cv::Mat1b& mask, double area) {
  std::vector<std::vector<cv::Point>> rings;
  cv::findContours(mask, rings, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto& ring = *std::max_element(rings.begin(), rings.end(),
                                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const double filled = cv::contourArea(ring) + 0.5 * cv::arcLength(ring, true);
  const cv::RotatedRect around = cv::minAreaRect(ring);
  if (filled > kRectangle * (around.size.width + 1.0) * (around.size.height + 1.0))
    return "a ruler or a card";
  cv::Point2f centre;
  float radius = 0.0f;
  cv::minEnclosingCircle(ring, centre, radius);
  if (filled > kDisc * std::numbers::pi * std::pow(radius + 0.5, 2)) return "a coin";
  cv::Mat1b framed;
  cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat1f depth;
  cv::distanceTransform(framed, depth, cv::DIST_L2, 5);
  double deepest = 0.0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  if (std::numbers::pi * deepest * deepest < kThinnest * area) return "a line";
  return {};
}

PhotoObject object_of(const cv::Mat1f& share, const cv::Mat1i& labels, int label, const cv::Rect& tight) {
  PhotoObject object;
  const cv::Rect whole({}, share.size());
  object.cut_off =
      tight.x == 0 || tight.y == 0 || tight.br().x == whole.width || tight.br().y == whole.height;
  object.box = cv::Rect(tight.x - 2, tight.y - 2, tight.width + 4, tight.height + 4) & whole;
  const cv::Mat1b mask = labels(object.box) == label;
  // The half-covered rim belongs to the object that it touches.
  cv::Mat1b others = (labels(object.box) != label) & (labels(object.box) != 0);
  object.share = share(object.box).clone();
  object.share.setTo(0.0f, others);
  cv::Mat1b near_it;
  cv::dilate(mask, near_it, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
  object.share.setTo(0.0f, ~near_it);
  object.area = cv::sum(object.share)[0];
  object.no_leaf_reason = why_no_leaf(mask, object.area);
  return object;
}

bool goes_before(const PhotoObject& a, const PhotoObject& b) {
  if (a.no_leaf_reason.empty() != b.no_leaf_reason.empty()) return a.no_leaf_reason.empty();
  const auto weight = [](const PhotoObject& o) { return o.cut_off ? kWholeWins * o.area : o.area; };
  return weight(a) > weight(b);
}

}  // namespace

std::vector<PhotoObject> photo_objects(const cv::Mat1f& share) {
  const cv::Mat1b covered = share >= 0.5f;
  cv::Mat1i labels, statistics;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(covered, labels, statistics, centroids, 8);
  std::vector<PhotoObject> objects;
  for (int label = 1; label < count; ++label) {
    if (statistics(label, cv::CC_STAT_AREA) < kSmallest * double(share.total())) continue;
    const cv::Rect tight(statistics(label, cv::CC_STAT_LEFT), statistics(label, cv::CC_STAT_TOP),
                         statistics(label, cv::CC_STAT_WIDTH), statistics(label, cv::CC_STAT_HEIGHT));
    objects.push_back(object_of(share, labels, label, tight));
  }
  double largest = 0.0;
  for (const PhotoObject& object : objects)
    if (object.no_leaf_reason.empty()) largest = std::max(largest, object.area);
  for (PhotoObject& object : objects) {
    if (!object.no_leaf_reason.empty()) continue;
    if (object.area < kSpeck * largest) object.no_leaf_reason = "a speck";
    if (object.cut_off && object.area < kEdgeThing * largest) object.no_leaf_reason = "a thing at the edge";
  }
  std::stable_sort(objects.begin(), objects.end(), goes_before);
  return objects;
}

}  // namespace wilt::detail
