#include "wilt/import/photo_cover.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <map>
#include <opencv2/imgproc.hpp>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

constexpr int kModelSide = 320;      // pixels of the reduced photo that the background is fitted to
constexpr double kRim = 0.04;        // width of the photo's rim, share of its sides
constexpr double kBin = 6.0;         // of the histogram of the rim's colours
constexpr double kSimilar = 24.0;    // difference from the commonest colour, at the start
constexpr double kFarthest = 14.0;   // and from the fitted background, at the end
constexpr double kLeast = 6.0;       // the smallest threshold
constexpr double kSureShare = 0.15;  // of the photo that the background fills at least
constexpr int kTerms = 10;

using Lab = cv::Vec3f;

// Lab with half the lightness: distances in it are those of the header.
cv::Mat3f working_colours(const cv::Mat3b& rgb) {
  cv::Mat3f lab;
  rgb.convertTo(lab, CV_32F, 1.0 / 255.0);
  cv::cvtColor(lab, lab, cv::COLOR_RGB2Lab);
  lab.forEach([](Lab& colour, const int*) { colour[0] *= 0.5f; });
  return lab;
}

std::array<float, kTerms> cubic_terms(float x, float y) {
  return {1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
}

// x and y from -1 to 1 over the photo.
struct Place {
  explicit Place(cv::Size size) : x_scale(2.0f / size.width), y_scale(2.0f / size.height) {}
  std::array<float, kTerms> operator()(int x, int y) const {
    return cubic_terms(x_scale * (x + 0.5f) - 1.0f, y_scale * (y + 0.5f) - 1.0f);
  }
  float x_scale, y_scale;
};

using Coefficients = Eigen::Matrix<float, 3, kTerms>;

Lab value_of(const Coefficients& cubic, const std::array<float, kTerms>& terms) {
  const Eigen::Vector3f value = cubic * Eigen::Map<const Eigen::Matrix<float, kTerms, 1>>(terms.data());
  return {value[0], value[1], value[2]};
}

// The commonest colour of the rim.
Lab rim_colour(const cv::Mat3f& colours) {
  const int width = std::max(1, static_cast<int>(kRim * colours.cols));
  const int height = std::max(1, static_cast<int>(kRim * colours.rows));
  std::map<std::array<int, 3>, std::pair<int, Lab>> bins;
  for (int y = 0; y < colours.rows; ++y) {
    for (int x = 0; x < colours.cols; ++x) {
      if (x >= width && x < colours.cols - width && y >= height && y < colours.rows - height) continue;
      const Lab& c = colours(y, x);
      auto& [count, sum] = bins[{cvFloor(c[0] / kBin), cvFloor(c[1] / kBin), cvFloor(c[2] / kBin)}];
      ++count;
      sum += c;
    }
  }
  const auto& most = std::max_element(bins.begin(), bins.end(), [](const auto& a, const auto& b) {
                       return a.second.first < b.second.first;
                     })->second;
  return most.second * (1.0f / most.first);
}

Coefficients fit(const cv::Mat3f& colours, const cv::Mat1b& is_background) {
  const Place place(colours.size());
  Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, 3> right = Eigen::Matrix<double, kTerms, 3>::Zero();
  for (int y = 0; y < colours.rows; ++y) {
    for (int x = 0; x < colours.cols; ++x) {
      if (!is_background(y, x)) continue;
      const auto terms = place(x, y);
      const auto t = Eigen::Map<const Eigen::Matrix<float, kTerms, 1>>(terms.data()).cast<double>().eval();
      const Lab& c = colours(y, x);
      normal += t * t.transpose();
      right += t * Eigen::RowVector3d(c[0], c[1], c[2]);
    }
  }
  // A little of Tikhonov's: where no background is seen the higher terms stay small.
  normal.diagonal().tail<kTerms - 1>().array() += 1e-3 * normal(0, 0);
  return normal.ldlt().solve(right).transpose().cast<float>();
}

cv::Mat1f difference(const cv::Mat3f& colours, const Coefficients& cubic) {
  const Place place(colours.size());
  cv::Mat1f result(colours.size());
  result.forEach([&](float& d, const int* at) {
    d = static_cast<float>(cv::norm(colours(at[0], at[1]) - value_of(cubic, place(at[1], at[0]))));
  });
  return result;
}

Coefficients fit_background(const cv::Mat3b& rgb) {
  cv::Mat3b small;
  const double reduction = std::max(1.0, std::max(rgb.cols, rgb.rows) / double(kModelSide));
  cv::resize(rgb, small, {}, 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
  const cv::Mat3f colours = working_colours(small);
  Coefficients cubic = Coefficients::Zero();
  const Lab rim = rim_colour(colours);
  cubic.col(0) << rim[0], rim[1], rim[2];
  double within = kSimilar;
  for (int round = 0; round < 5; ++round) {
    const cv::Mat1b similar = difference(colours, cubic) < within;
    const double share = cv::countNonZero(similar) / double(similar.total());
    if (share < kSureShare)
      throw Error(ErrorCode::input,
                  fmt::format("no plain background was found: only {:.0f} % of the photo has the colour of "
                              "its rim; put the leaf on white paper or dark cloth, or pass --mask mask.png "
                              "(white where the leaf is)",
                              100.0 * share));
    cubic = fit(colours, similar);
    within = std::max(kFarthest, 0.75 * within);
  }
  return cubic;
}

// Otsu's threshold of differences from 0 to 64.
double otsu(const cv::Mat1f& differences) {
  cv::Mat1b levels;
  differences.convertTo(levels, CV_8U, 4.0);
  cv::Mat1b ignored;
  return cv::threshold(levels, ignored, 0, 255, cv::THRESH_OTSU) / 4.0;
}

// The colour of what is surely an object, averaged nearby; zero weight where there is none.
struct NearbyColour {
  cv::Mat3f sum;
  cv::Mat1f weight;
};

NearbyColour nearby_colour(const cv::Mat3f& colours, const cv::Mat1f& differences, double threshold) {
  NearbyColour nearby;
  cv::Mat1b sure = differences > 1.25 * threshold, inner;
  cv::erode(sure, inner, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  // Needles lose everything to erosion: they count with what they have, faintly.
  nearby.weight = cv::Mat1f(colours.size());
  nearby.weight.forEach([&](float& w, const int* at) {
    w = inner(at[0], at[1]) ? 1.0f : sure(at[0], at[1]) ? 0.02f : 0.0f;
  });
  nearby.sum = cv::Mat3f(colours.size());
  nearby.sum.forEach([&](Lab& s, const int* at) { s = nearby.weight(at[0], at[1]) * colours(at[0], at[1]); });
  cv::GaussianBlur(nearby.sum, nearby.sum, {}, 2.5);
  cv::GaussianBlur(nearby.weight, nearby.weight, {}, 2.5);
  return nearby;
}

// Pixels within two of the edge between what is above the threshold and what is below.
cv::Mat1b edge_band(const cv::Mat1b& above) {
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::Mat1b wide, narrow;
  cv::dilate(above, wide, disc);
  cv::erode(above, narrow, disc);
  return wide & ~narrow;
}

}  // namespace

Cover cover_of_alpha(const cv::Mat1b& alpha) {
  Cover cover;
  alpha.convertTo(cover.share, CV_32F, 1.0 / 255.0);
  return cover;
}

Cover cover_of_colours(const cv::Mat3b& rgb, std::optional<double> threshold) {
  const Coefficients background = fit_background(rgb);
  const cv::Mat3f colours = working_colours(rgb);
  const cv::Mat1f differences = difference(colours, background);
  Cover cover;
  cover.threshold = threshold.value_or(std::max(kLeast, otsu(differences)));
  const cv::Mat1b above = differences > cover.threshold;
  const cv::Mat1b band = edge_band(above);
  const NearbyColour nearby = nearby_colour(colours, differences, cover.threshold);
  const Place place(rgb.size());
  cover.share = cv::Mat1f(rgb.size());
  cover.share.forEach([&](float& share, const int* at) {
    const int y = at[0], x = at[1];
    share = above(y, x) ? 1.0f : 0.0f;
    if (!band(y, x)) return;
    const float weight = nearby.weight(y, x);
    if (weight < 1e-4f) return;
    const Lab behind = value_of(background, place(x, y));
    const Lab across = nearby.sum(y, x) * (1.0f / weight) - behind;
    share =
        std::clamp((colours(y, x) - behind).dot(across) / std::max(across.dot(across), 1e-6f), 0.0f, 1.0f);
  });
  return cover;
}

}  // namespace wilt::detail
