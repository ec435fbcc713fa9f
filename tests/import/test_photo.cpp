// Photos that are painted here, so that everything about the leaf in them is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "import/files.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/import/photo_cover.hpp"
#include "wilt/import/photo_file.hpp"
#include "wilt/import/photo_objects.hpp"
#include "wilt/import/photo_outline.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

constexpr double kPi = std::numbers::pi;
const cv::Scalar kGreen(60, 120, 40), kPaper(235, 232, 225), kCloth(30, 28, 34);

// Five lobes and fine teeth around a centre; the notch at angle 0 is the deepest.
struct PaintedLeaf {
  Vec2 centre{420.3, 380.7};
  double size = 240.0;

  Vec2 at(double angle) const {
    const double r = size * (0.72 + 0.2 * std::cos(5.0 * angle + kPi) + 0.02 * std::cos(40.0 * angle) -
                             0.35 * std::exp(-8.0 * angle * angle) -
                             0.35 * std::exp(-8.0 * std::pow(angle - 2.0 * kPi, 2)));
    return centre + r * Vec2(std::cos(angle), std::sin(angle));
  }
  std::vector<Vec2> ring() const {
    std::vector<Vec2> points;
    for (int i = 0; i < 4000; ++i) points.push_back(at(2.0 * kPi * i / 4000));
    return points;
  }
};

double area_of(const std::vector<Vec2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

double distance_to(const std::vector<Vec2>& ring, const Vec2& p) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], u = ring[(i + 1) % ring.size()] - a;
    const double t = std::clamp((p - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * u - p).norm());
  }
  return least;
}

// Pixel (0, 0) covers 0 to 1: OpenCV's coordinates are those of its middle.
void paint(cv::Mat3b& photo, const std::vector<Vec2>& ring, const cv::Scalar& colour) {
  constexpr int kOver = 8;  // supersampling: shares to 1/64
  cv::Mat1b fine(photo.rows * kOver, photo.cols * kOver, uchar(0));
  std::vector<cv::Point> points;
  for (const Vec2& p : ring)
    points.emplace_back((p * kOver - Vec2(0.5, 0.5)).x() * 16, (p * kOver - Vec2(0.5, 0.5)).y() * 16);
  cv::fillPoly(fine, std::vector<std::vector<cv::Point>>{points}, cv::Scalar(255), cv::LINE_8, 4);
  cv::Mat1b share;
  cv::resize(fine, share, photo.size(), 0, 0, cv::INTER_AREA);
  for (int y = 0; y < photo.rows; ++y)
    for (int x = 0; x < photo.cols; ++x)
      for (int c = 0; c < 3; ++c)
        photo(y, x)[c] =
            cv::saturate_cast<uchar>(photo(y, x)[c] + (colour[c] - photo(y, x)[c]) * share(y, x) / 255.0);
}

// Light that falls off to one corner, and the sensor's noise.
void light_and_noise(cv::Mat3b& photo, double fall_off, double noise) {
  std::mt19937 random(7);
  for (int y = 0; y < photo.rows; ++y) {
    for (int x = 0; x < photo.cols; ++x) {
      const double light = 1.0 - fall_off * (x / double(photo.cols) + y / double(photo.rows)) / 2;
      for (int c = 0; c < 3; ++c) {
        const double grain = noise * (double(random()) / 4294967295.0 - 0.5) * std::sqrt(12.0);
        photo(y, x)[c] = cv::saturate_cast<uchar>(light * photo(y, x)[c] + grain);
      }
    }
  }
}

cv::Mat3b blank(const cv::Scalar& colour) {
  return cv::Mat3b(800, 900, cv::Vec3b(uchar(colour[0]), uchar(colour[1]), uchar(colour[2])));
}

Image image_of(const cv::Mat3b& photo) {
  return {photo.cols, photo.rows, {photo.data, photo.data + 3 * photo.total()}};
}

class PhotoLeaf : public test::Files {};

struct Background {
  const char* name;
  cv::Scalar colour;
  double fall_off, noise;
};

class Segmentation : public testing::TestWithParam<Background> {};

// Oracle: the curve that was painted. Half a pixel of the edge would be 1.3 % of the area.
TEST_P(Segmentation, FindsTheOutlineToAFractionOfAPixel) {
  const Background& background = GetParam();
  const PaintedLeaf leaf;
  cv::Mat3b photo = blank(background.colour);
  paint(photo, leaf.ring(), kGreen);
  light_and_noise(photo, background.fall_off, background.noise);
  const auto cover = detail::cover_of_colours(photo, {});
  const auto objects = detail::photo_objects(cover.share);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].no_leaf_reason, "");
  const Outline outline = detail::trace_outline(objects[0], 1.0);
  EXPECT_NO_THROW(validate_outline(outline));
  EXPECT_TRUE(outline.holes.empty());
  const std::vector<Vec2> ring = leaf.ring();
  std::vector<Vec2> traced;
  double squares = 0.0, largest = 0.0;
  for (int i = 0; i < outline.margin.rows(); ++i) {
    traced.emplace_back(outline.margin(i, 0), -outline.margin(i, 1));
    const double distance = distance_to(ring, traced.back());
    squares += distance * distance;
    largest = std::max(largest, distance);
  }
  EXPECT_NEAR(area_of(traced) / area_of(ring), 1.0, 0.002);
  EXPECT_LT(std::sqrt(squares / double(traced.size())), 0.15);  // noise 4 of a contrast of some 150 / 255: .1
  EXPECT_LT(largest, 0.7);
}

INSTANTIATE_TEST_SUITE_P(Backgrounds, Segmentation,
                         testing::Values(Background{"Paper", kPaper, 0.0, 0.0},
                                         Background{"UnevenlyLitPaper", kPaper, 0.35, 4.0},
                                         Background{"Cloth", kCloth, 0.3, 4.0},
                                         Background{"LightTable", {254, 254, 250}, 0.05, 2.0}),
                         [](const auto& test) { return std::string(test.param.name); });

// Oracle: the painting. What has a leaf's shape is chosen, holes are kept, soft shadows are not.
TEST(PhotoObjects, TellALeafFromRulersCoinsStringsAndShadows) {
  PaintedLeaf leaf;
  cv::Mat3b photo = blank(kPaper);
  std::vector<Vec2> shadow;
  for (const Vec2& p : leaf.ring()) shadow.push_back(p + Vec2(14.0, 10.0));
  paint(photo, shadow, {196, 195, 192});
  cv::GaussianBlur(photo, photo, {}, 5.0);
  paint(photo, leaf.ring(), kGreen);
  cv::circle(photo, {400, 480}, 14, kPaper, cv::FILLED, cv::LINE_AA);
  cv::rectangle(photo, {40, 740}, {860, 790}, {200, 170, 60}, cv::FILLED);
  cv::circle(photo, {800, 100}, 45, {150, 120, 80}, cv::FILLED, cv::LINE_AA);
  cv::line(photo, {30, 20}, {700, 40}, {40, 60, 200}, 4, cv::LINE_AA);
  const auto objects = detail::photo_objects(detail::cover_of_colours(photo, {}).share);
  ASSERT_GE(objects.size(), 4U);
  EXPECT_EQ(objects[0].no_leaf_reason, "");
  EXPECT_NEAR(objects[0].area / (area_of(leaf.ring()) - kPi * 14 * 14), 1.0, 0.02);
  EXPECT_EQ(detail::trace_outline(objects[0], 1.0).holes.size(), 1U);
  std::vector<std::string> reasons;
  for (std::size_t i = 1; i < objects.size(); ++i) reasons.push_back(objects[i].no_leaf_reason);
  std::sort(reasons.begin(), reasons.end());
  EXPECT_EQ(reasons, (std::vector<std::string>{"a coin", "a line", "a ruler or a card"}));
}

// Oracle: analytic; lengths in texture coordinates x pixels x mm per pixel are lengths of the leaf, but for
// its relief, and the texels under the blade are the photo's.
TEST_F(PhotoLeaf, HasTextureCoordinatesThatMatchToThePixel) {
  const PaintedLeaf painted;
  cv::Mat3b photo = blank(kPaper);
  paint(photo, painted.ring(), kGreen);
  for (int y = 0; y < photo.rows; ++y)  // so that every pixel of the leaf is another
    for (int x = 0; x < photo.cols; ++x)
      if (photo(y, x)[0] < 100) photo(y, x) = {uchar(40 + x % 40), uchar(100 + y % 40), 40};
  ReadOptions options;
  options.mm_per_pixel = 0.25;
  const Leaf leaf = read_leaf(write("pixels.png", encode_png(image_of(photo))), options);
  ASSERT_TRUE(leaf.photo);
  const PhotoArea& area = leaf.photo->area;
  const auto pixel = [&](VertexId v) {
    return Vec2(area.origin + leaf.skin.uv.row(int(v)).transpose().cwiseProduct(area.size));
  };
  EXPECT_LT((pixel(leaf.petiole) - painted.at(0.0)).norm(), 5.0);  // the edges of the mesh are 5 pixels long
  for (const VertexId v : leaf.mesh.vertices()) {
    const double flat = leaf.positions.row(v).head<2>().norm();
    EXPECT_NEAR(flat, 0.25e-3 * (pixel(v) - pixel(leaf.petiole)).norm(), 1e-9);
  }
  const Image& texture = leaf.photo->image;
  int compared = 0;
  for (int y = 200; y < 560; y += 7) {
    for (int x = 250; x < 600; x += 7) {
      if ((Vec2(x, y) - painted.centre).norm() > 35.0) continue;
      const int u = x - static_cast<int>(std::lround(area.origin.x())),
                v = y - static_cast<int>(std::lround(area.origin.y()));
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(int(texture.pixel(u, v)[c]), int(photo(y, x)[c])) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
  // Beyond the margin the leaf's colours go on.
  EXPECT_LT(texture.pixel(2, 2)[0], 100);
}

// Oracle: invariance; the same leaf on its side, by the camera's note or by the pixels, has the same size.
TEST_F(PhotoLeaf, StandsUprightByItsExifOrientation) {
  const PaintedLeaf painted;
  cv::Mat3b photo = blank(kPaper), turned;
  paint(photo, painted.ring(), kGreen);
  cv::rotate(photo, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  std::string jpeg = encode_jpeg(image_of(turned), 98);
  const std::string exif(
      "\xff\xe1\x00\x22"
      "Exif\0\0"
      "MM\0\x2a\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
      "\0\0\0\0",
      36);
  jpeg.insert(2, exif);
  EXPECT_EQ(detail::exif_orientation(jpeg), 6);
  const detail::Photo read = detail::parse_photo(jpeg);
  ASSERT_EQ(read.rgb.size(), photo.size());
  EXPECT_LT(cv::norm(read.rgb, photo, cv::NORM_L1) / (3.0 * double(photo.total())), 2.0);
  for (std::size_t length = 0; length < 60; ++length) detail::exif_orientation(jpeg.substr(0, length));
}

// Veins of a palmate leaf whose basal lobes overlap: no sinus leads to the petiole in the outline.
cv::Mat3b closed_sinus(const Vec2& petiole, const std::vector<double>& veins = {90, 25, 155, -30, 210}) {
  cv::Mat3b photo = blank({250, 250, 245});
  std::vector<Vec2> ring;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2.0 * kPi * i / 2000;
    const double lobes = 250.0 + 30.0 * std::cos(5.0 * (angle - kPi / 2));
    const double notch = 40.0 * std::exp(-60.0 * std::pow(std::remainder(angle + kPi / 2, 2.0 * kPi), 2));
    ring.push_back(Vec2(450.0, 420.0) + (lobes - notch) * Vec2(std::cos(angle), std::sin(angle)));
  }
  paint(photo, ring, kGreen);
  for (const double degrees : veins) {
    const double angle = degrees * kPi / 180.0;
    const Vec2 end = petiole + 190.0 * Vec2(std::cos(angle), std::sin(angle));
    cv::line(photo, cv::Point2d(petiole.x(), petiole.y()), cv::Point2d(end.x(), end.y()), {120, 160, 80}, 5,
             cv::LINE_AA);
  }
  light_and_noise(photo, 0.0, 3.0);
  return photo;
}

// Oracle: where the painted veins meet; 5 pixels are a hundredth of the leaf.
TEST_F(PhotoLeaf, FindsAPetioleBehindLobesThatOverlapByTheVeins) {
  const Vec2 petiole(455.0, 330.0);
  const std::string file = write("closed.png", encode_png(image_of(closed_sinus(petiole))));
  const Leaf leaf = read_leaf(file);
  const PhotoArea& area = leaf.photo->area;
  const Vec2 found = area.origin + leaf.skin.uv.row(int(leaf.petiole)).transpose().cwiseProduct(area.size);
  EXPECT_LT((found - petiole).norm(), 7.0);
  for (const char* words : {"main veins meet", "cut open", "--mm-per-pixel"})
    EXPECT_TRUE(test::has_note(leaf, words)) << words << '\n' << test::notes_of(leaf);
  ReadOptions by_hand;
  by_hand.petiole = petiole;
  EXPECT_LT((read_leaf(file, by_hand).positions.row(0) - leaf.positions.row(0)).norm(), 0.01);
}

// Oracle: botany; where veins leave a midrib in pairs there is no petiole.
TEST_F(PhotoLeaf, TakesNoNodeOfAPinnateLeafForItsPetiole) {
  const cv::Mat3b photo = closed_sinus(Vec2(455, 400), {90, 45, 135, -90, 60, 120});
  const Leaf leaf = read_leaf(write("pinnate.png", encode_png(image_of(photo))));
  EXPECT_FALSE(test::has_note(leaf, "main veins meet")) << test::notes_of(leaf);
}

// Oracle: the mask, which has another leaf than the photo.
TEST_F(PhotoLeaf, BelievesAMaskAndAnAlphaChannel) {
  const PaintedLeaf painted{Vec2(450.0, 400.0), 200.0};
  cv::Mat3b mask = blank({0, 0, 0});
  paint(mask, painted.ring(), {255, 255, 255});
  ReadOptions options;
  options.mm_per_pixel = 1.0;
  options.mask = write("mask.png", encode_png(image_of(mask)));
  const Leaf leaf = read_leaf(write("plain.png", encode_png(image_of(blank(kPaper)))), options);
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions) / (1e-6 * area_of(painted.ring())), 1.0, 0.03);
  options.mask = write("wide.png", encode_png({100, 300, std::vector<std::uint8_t>(90000)}));
  EXPECT_THROW(read_leaf(write("plain.png", encode_png(image_of(blank(kPaper)))), options), Error);
}

// Negative: each says what to do.
TEST_F(PhotoLeaf, SaysWhatItCannotUse) {
  const auto refused = [this](const cv::Mat3b& photo, const ReadOptions& options = {}) {
    return refusal(write("refused.png", encode_png(image_of(photo))), options);
  };
  cv::Mat3b busy = blank(kPaper);
  cv::randu(busy, 0, 255);
  cv::resize(busy(cv::Rect(0, 0, 60, 60)).clone(), busy, busy.size(), 0, 0, cv::INTER_NEAREST);
  EXPECT_NE(refused(busy).find("no plain background"), std::string::npos);
  EXPECT_NE(refused(blank(kPaper)).find("nothing in the photo stands out"), std::string::npos);
  EXPECT_NE(refused(blank(kPaper)(cv::Rect(0, 0, 40, 40)).clone()).find("needs 64"), std::string::npos);
  cv::Mat3b one = blank(kPaper);
  paint(one, PaintedLeaf().ring(), kGreen);
  ReadOptions second;
  second.nth = 2;
  EXPECT_NE(refused(one, second).find("shows 1"), std::string::npos);
}

}  // namespace
}  // namespace wilt
