#include "wilt/import/svg_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <svgpp/factory/integer_color.hpp>
#include <svgpp/parser/paint.hpp>
#include <svgpp/parser/path_data.hpp>
#include <svgpp/parser/transform_list.hpp>
#include <svgpp/policy/path.hpp>
#include <svgpp/policy/transform.hpp>

#include "wilt/core/error.hpp"

namespace wilt::svg {
namespace {

// Receives svgpp's path events; with policy::path::minimal arcs and quadratics arrive as cubics.
class Flattener {
 public:
  Flattener(const Transform& transform, double tolerance) : transform_(transform), tolerance_(tolerance) {}

  void path_move_to(double x, double y, svgpp::tag::coordinate::absolute) {
    finish();
    start_ = current_ = Vec2(x, y);
    ring_.push_back(transform_ * current_);
  }
  void path_line_to(double x, double y, svgpp::tag::coordinate::absolute) {
    begin();
    current_ = Vec2(x, y);
    ring_.push_back(transform_ * current_);
  }
  void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y,
                            svgpp::tag::coordinate::absolute) {
    begin();
    const Vec2 end(x, y);
    cubic(transform_ * current_, transform_ * Vec2(x1, y1), transform_ * Vec2(x2, y2), transform_ * end, 0);
    current_ = end;
  }
  void path_close_subpath() {
    finish();
    current_ = start_;
  }
  void path_exit() { finish(); }

  std::vector<Ring> take() { return std::move(rings_); }

 private:
  // A drawing command after a closed subpath starts a new one where that one began.
  void begin() {
    if (ring_.empty()) ring_.push_back(transform_ * current_);
  }

  void finish() {
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (ring_.size() >= 3) rings_.push_back(std::move(ring_));
    ring_.clear();
  }

  // Halves the curve until its control points lie within the tolerance of its thirds (the classical bound:
  // a cubic stays within 1/4 of the largest second difference of its polygon).
  void cubic(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, int depth) {
    const double deviation = std::max((a - 2 * b + c).norm(), (b - 2 * c + d).norm());
    if (depth >= 2 && (depth >= 16 || !(0.75 * deviation > tolerance_))) {
      ring_.push_back(d);
      return;
    }
    const Vec2 ab = (a + b) / 2, bc = (b + c) / 2, cd = (c + d) / 2;
    const Vec2 abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
    cubic(a, ab, abc, middle, depth + 1);
    cubic(middle, bcd, cd, d, depth + 1);
  }

  Transform transform_;
  double tolerance_;
  Vec2 start_ = Vec2::Zero(), current_ = Vec2::Zero();
  Ring ring_;
  std::vector<Ring> rings_;
};

struct TransformReceiver {
  Transform transform = Transform::Identity();
  void transform_matrix(const boost::array<double, 6>& m) {
    transform.matrix() << m[0], m[2], m[4], m[1], m[3], m[5], 0, 0, 1;
  }
};

struct PaintReceiver {
  Paint paint;

  void set(svgpp::tag::attribute::fill, svgpp::tag::value::none) { paint.kind = Paint::Kind::none; }
  void set(svgpp::tag::attribute::fill, svgpp::tag::value::currentColor) {}
  void set(svgpp::tag::attribute::fill, svgpp::tag::value::inherit) { paint.kind = Paint::Kind::inherit; }
  void set(svgpp::tag::attribute::fill, int rgb) {
    paint.red = (rgb >> 16 & 255) / 255.0;
    paint.green = (rgb >> 8 & 255) / 255.0;
    paint.blue = (rgb & 255) / 255.0;
  }
  template <class... Iri>
  void set(svgpp::tag::attribute::fill, const Iri&...) {
    paint.kind = Paint::Kind::server;
  }
};

// svgpp's grammars are ASCII, and what they look words up with takes nothing else.
bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
}

std::string shortened(const std::string& text) {
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

}  // namespace

std::vector<Ring> flatten_path(const std::string& data, const Transform& transform, double tolerance) {
  Flattener flattener(transform, tolerance);
  using Parser =
      svgpp::value_parser<svgpp::tag::type::path_data, svgpp::path_policy<svgpp::policy::path::minimal>>;
  bool read = false;
  try {
    read = is_ascii(data) &&
           Parser::parse(svgpp::tag::attribute::d(), flattener, data, svgpp::tag::source::attribute());
  } catch (const std::exception&) {
    read = false;
  }
  if (!read)
    throw Error(ErrorCode::input, fmt::format("the path data \"{}\" cannot be read; it must follow SVG's "
                                              "grammar of M, L, C, Q, A and Z commands",
                                              shortened(data)));
  return flattener.take();
}

Transform parse_transform(const std::string& text) {
  TransformReceiver receiver;
  bool read = false;
  try {
    read = is_ascii(text) &&
           svgpp::value_parser<svgpp::tag::type::transform_list>::parse(
               svgpp::tag::attribute::transform(), receiver, text, svgpp::tag::source::attribute());
  } catch (const std::exception&) {
    read = false;
  }
  if (!read)
    throw Error(ErrorCode::input,
                fmt::format("the transform \"{}\" cannot be read; allowed are matrix, translate, scale, "
                            "rotate, skewX and skewY",
                            shortened(text)));
  return receiver.transform;
}

std::optional<Paint> parse_paint(const std::string& text) {
  PaintReceiver receiver;
  if (!is_ascii(text)) {
    if (text.rfind("url(", 0) != 0) return std::nullopt;
    receiver.paint.kind = Paint::Kind::server;
    return receiver.paint;
  }
  try {
    if (svgpp::value_parser<svgpp::tag::type::paint>::parse(svgpp::tag::attribute::fill(), receiver, text,
                                                            svgpp::tag::source::css()))
      return receiver.paint;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

std::optional<Length> parse_length(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  // "1em" must not be read as a number with an exponent: digits first, then letters.
  const std::size_t digits = text.find_last_of("0123456789.");
  if (digits == std::string::npos) return std::nullopt;
  in.str(text.substr(0, digits + 1));
  Length length;
  if (!(in >> length.value) || !std::isfinite(length.value) || !(in >> std::ws).eof()) return std::nullopt;
  std::istringstream rest(text.substr(digits + 1));
  rest >> length.unit;
  return length;
}

std::optional<double> millimetres(const std::string& unit) {
  if (unit == "mm") return 1.0;
  if (unit == "cm") return 10.0;
  if (unit == "in") return 25.4;
  if (unit == "pt") return 25.4 / 72.0;
  if (unit == "pc") return 25.4 / 6.0;
  if (unit == "Q") return 0.25;
  return std::nullopt;
}

}  // namespace wilt::svg
