#include "wilt/import/photo_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

constexpr double kSmallestHole = 16.0;  // pixels

// Marching squares over the middles of the pixels. The line crosses edges between neighbours; edge 2 i is the
// one from pixel i to the right, 2 i + 1 the one downwards. Covered pixels lie on its left, y down.
class Contour {
 public:
  explicit Contour(const cv::Mat1f& share) : share_(share), next_(2 * share.total(), -1) {
    for (int y = 0; y + 1 < share.rows; ++y)
      for (int x = 0; x + 1 < share.cols; ++x) cross_cell(x, y);
  }

  /// The closed lines, each as points; empties the contour.
  std::vector<std::vector<cv::Point2f>> take_rings() {
    std::vector<std::vector<cv::Point2f>> rings;
    for (int start = 0; start < static_cast<int>(next_.size()); ++start) {
      if (next_[static_cast<std::size_t>(start)] < 0) continue;
      std::vector<cv::Point2f>& ring = rings.emplace_back();
      for (int edge = start; next_[static_cast<std::size_t>(edge)] >= 0;) {
        ring.push_back(point(edge));
        edge = std::exchange(next_[static_cast<std::size_t>(edge)], -1);
      }
    }
    return rings;
  }

 private:
  bool covered(int x, int y) const { return share_(y, x) >= 0.5f; }
  int right_of(int x, int y) const { return 2 * (y * share_.cols + x); }
  int below(int x, int y) const { return right_of(x, y) + 1; }
  void join(int from, int to) { next_[static_cast<std::size_t>(from)] = to; }

  // Walks around the cell: where it steps from covered to free the line leaves, where from free to covered it
  // enters. Of a saddle's two ways the one that keeps the covered corners together is taken when the middle
  // is covered.
  void cross_cell(int x, int y) {
    const std::array<bool, 4> corner{covered(x, y), covered(x + 1, y), covered(x + 1, y + 1),
                                     covered(x, y + 1)};
    const std::array<int, 4> edge{right_of(x, y), below(x + 1, y), right_of(x, y + 1), below(x, y)};
    std::array<int, 2> in{-1, -1}, out{-1, -1};  // positions of edges around the cell
    int ins = 0, outs = 0;
    for (int k = 0; k < 4; ++k) {
      const bool here = corner[static_cast<std::size_t>(k)],
                 there = corner[static_cast<std::size_t>((k + 1) % 4)];
      if (here && !there) out[static_cast<std::size_t>(outs++)] = k;
      if (!here && there) in[static_cast<std::size_t>(ins++)] = k;
    }
    const auto at = [&](int k) { return edge[static_cast<std::size_t>(k)]; };
    if (ins == 1) join(at(in[0]), at(out[0]));
    if (ins != 2) return;
    const bool middle = share_(y, x) + share_(y, x + 1) + share_(y + 1, x) + share_(y + 1, x + 1) >= 2.0f;
    // Around the cell ins and outs alternate; joining an in to the out before it cuts off a free corner.
    for (const int i : in) join(at(i), at((i + (middle ? 3 : 1)) % 4));
  }

  cv::Point2f point(int edge) const {
    const int x = edge / 2 % share_.cols, y = edge / 2 / share_.cols;
    const float a = share_(y, x), b = edge % 2 == 0 ? share_(y, x + 1) : share_(y + 1, x);
    const float t = std::clamp((0.5f - a) / (b - a), 0.02f, 0.98f);  // lines do not meet in a pixel's middle
    return edge % 2 == 0 ? cv::Point2f(float(x) + t, float(y)) : cv::Point2f(float(x), float(y) + t);
  }

  const cv::Mat1f& share_;
  std::vector<int> next_;  // the edge that the line crosses next; -1: none
};

}  // namespace

Outline trace_outline(const PhotoObject& object, double scale) {
  cv::Mat1f share;
  cv::copyMakeBorder(object.share, share, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0.0));
  const auto rings = Contour(share).take_rings();
  const auto area = [](const std::vector<cv::Point2f>& ring) { return cv::contourArea(ring, true); };
  const auto in_file = [&](const std::vector<cv::Point2f>& ring) {
    Points2 points(static_cast<Eigen::Index>(ring.size()), 2);
    for (std::size_t i = 0; i < ring.size(); ++i)
      points.row(static_cast<Eigen::Index>(i)) << scale * (object.box.x + ring[i].x - 0.5),
          -scale * (object.box.y + ring[i].y - 0.5);
    return points;
  };
  const auto largest = std::max_element(rings.begin(), rings.end(), [&](const auto& a, const auto& b) {
    return std::abs(area(a)) < std::abs(area(b));
  });
  if (largest == rings.end() || std::abs(area(*largest)) < kSmallestHole)
    throw Error(ErrorCode::input, "the leaf in the photo is too small to have an outline");
  Outline outline;
  outline.margin = in_file(*largest);
  for (const auto& ring : rings) {
    const bool is_hole = area(ring) * area(*largest) < 0.0 && std::abs(area(ring)) >= kSmallestHole;
    if (is_hole && cv::pointPolygonTest(*largest, ring.front(), false) > 0)
      outline.holes.push_back(in_file(ring));
  }
  return outline;
}

}  // namespace wilt::detail
