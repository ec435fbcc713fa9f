#include "wilt/import/svg_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "wilt/core/error.hpp"
#include "wilt/import/svg_style.hpp"

namespace wilt::svg {
namespace {

// A few lines of <use> within <use> may stand for any number of shapes: an element counts as kElementCost
// bytes of path data.
constexpr std::size_t kMostData = 100'000'000, kElementCost = 100;

// What a shape inherits from the groups around it.
struct State {
  Transform transform = Transform::Identity();
  Paint paint;
  bool even_odd = false;
  bool visible = true;
  double opacity = 1.0;
  double fill_opacity = 1.0;
  bool blurred = false;
};

struct Pending {
  std::string data;  // path data
  State state;
};

// The numbers of a viewBox, separated by blanks or commas.
std::vector<double> numbers_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

class Walker {
 public:
  explicit Walker(const Elements& elements)
      : elements_(elements), root_(elements.front()), styles_(elements) {
    const std::vector<double> box = numbers_of(attribute(root_, "viewBox"));
    if (box.size() == 4 && box[2] > 0 && box[3] > 0) view_box_ = box;
    page_ = view_box_.empty() ? Vec2(length(root_, "width", 0, 100), length(root_, "height", 1, 100))
                              : Vec2(view_box_[2], view_box_[3]);
  }

  std::vector<Pending> shapes() {
    pending_.clear();
    walk_children(root_, enter(root_, State()), 0);
    return pending_;
  }

  // Millimetres per unit of the viewBox, when width and height are physical lengths.
  std::optional<double> physical_scale() const {
    if (view_box_.empty()) return std::nullopt;
    double scale = std::numeric_limits<double>::infinity();
    for (const int axis : {0, 1}) {
      const auto size = parse_length(attribute(root_, axis == 0 ? "width" : "height"));
      if (!size || !millimetres(size->unit) || !(size->value > 0)) return std::nullopt;
      scale = std::min(scale, size->value * *millimetres(size->unit) / view_box_[2 + axis]);
    }
    return scale;
  }

 private:
  // A length attribute in user units.
  double length(const Element& element, const char* name, int axis, double otherwise = 0.0) const {
    const auto parsed = parse_length(attribute(element, name));
    if (!parsed) return otherwise;
    if (parsed->unit == "%")
      return parsed->value / 100 * (axis < 2 ? page_[axis] : page_.norm() / std::sqrt(2));
    if (const auto mm = millimetres(parsed->unit)) return parsed->value * *mm * 96 / 25.4;
    return parsed->value;
  }

  double opacity_property(const Element& element, const char* name, double otherwise) const {
    const auto parsed = parse_length(styles_.property(element, name));
    if (!parsed) return otherwise;
    return std::clamp(parsed->unit == "%" ? parsed->value / 100 : parsed->value, 0.0, 1.0);
  }

  bool is_blur(const std::string& filter) const {
    const std::size_t from = filter.find('#'), to = filter.find_first_of("\"')", from);
    if (filter.rfind("url(", 0) != 0 || from == std::string::npos || to == std::string::npos) return false;
    const Element* node = by_id(filter.substr(from + 1, to - from - 1));
    if (node == nullptr) return false;
    for (std::size_t i = place_of(*node) + 1; i < node->end; ++i)
      if (local_name(elements_[i]) == "feGaussianBlur") return true;
    return false;
  }

  std::size_t place_of(const Element& element) const {
    return static_cast<std::size_t>(&element - elements_.data());
  }

  const Element* by_id(const std::string& id) const {
    const auto found = std::find_if(elements_.begin() + 1, elements_.end(),
                                    [&](const Element& element) { return attribute(element, "id") == id; });
    return found == elements_.end() ? nullptr : &*found;
  }

  State enter(const Element& element, State state) const {
    const std::string transform = attribute(element, "transform");
    if (!transform.empty()) state.transform = state.transform * parse_transform(transform);
    if (const std::string fill = styles_.property(element, "fill"); !fill.empty()) {
      const auto paint = parse_paint(fill);
      if (paint && paint->kind != Paint::Kind::inherit) state.paint = *paint;
    }
    if (const std::string rule = styles_.property(element, "fill-rule"); !rule.empty() && rule != "inherit")
      state.even_odd = rule == "evenodd";
    if (const std::string seen = styles_.property(element, "visibility"); !seen.empty() && seen != "inherit")
      state.visible = seen == "visible";
    state.fill_opacity = opacity_property(element, "fill-opacity", state.fill_opacity);
    state.opacity *= opacity_property(element, "opacity", 1.0);
    state.blurred = state.blurred || is_blur(styles_.property(element, "filter"));
    return state;
  }

  void walk_children(const Element& parent, const State& state, int depth) {
    for (std::size_t i = place_of(parent) + 1; i < parent.end; i = elements_[i].end)
      walk(elements_[i], state, depth);
  }

  void walk(const Element& element, const State& inherited, int depth) {
    static const std::set<std::string> groups{"svg", "g", "a", "switch"};
    if (depth > 200 || styles_.property(element, "display") == "none") return;
    spend(kElementCost);
    const std::string name = local_name(element);
    if (groups.count(name) > 0) {
      walk_children(element, placed(element, enter(element, inherited), name == "svg"), depth + 1);
    } else if (name == "use") {
      const std::string& plain = attribute(element, "href");
      const std::string& link = plain.empty() ? attribute(element, "xlink:href") : plain;
      const Element* target = link.empty() ? nullptr : by_id(link.substr(1));
      if (target == nullptr || depth > 20) return;
      const State state = placed(element, enter(element, inherited), true);
      if (local_name(*target) == "symbol")
        walk_children(*target, enter(*target, state), depth + 10);
      else
        walk(*target, state, depth + 10);
    } else if (const std::string data = path_data(element, name); !data.empty()) {
      spend(data.size());
      const State state = enter(element, inherited);
      if (state.visible && state.paint.kind != Paint::Kind::none) pending_.push_back({data, state});
    }
  }

  void spend(std::size_t cost) {
    data_ += cost;
    if (data_ > kMostData)
      throw Error(
          ErrorCode::input,
          fmt::format(
              "the drawing holds more than {} MB of shapes, those that <use> repeats counted; keep the "
              "leaf alone",
              kMostData / 1'000'000));
  }

  State placed(const Element& element, State state, bool moves) const {
    if (moves)
      state.transform =
          state.transform * Eigen::Translation2d(length(element, "x", 0), length(element, "y", 1));
    return state;
  }

  // Every shape as path data; "" for what is none.
  std::string path_data(const Element& e, const std::string& name) const {
    if (name == "path") return attribute(e, "d");
    if (name == "polygon" || name == "polyline") {
      const std::string& points = attribute(e, "points");
      return points.empty() ? "" : "M" + points + "Z";
    }
    if (name == "rect") return rectangle(e);
    double rx = 0, ry = 0;
    if (name == "circle") rx = ry = length(e, "r", 2);
    if (name == "ellipse") {
      rx = length(e, "rx", 0);
      ry = length(e, "ry", 1);
    }
    if (!(rx > 0 && ry > 0)) return "";
    const double x = length(e, "cx", 0), y = length(e, "cy", 1);
    return fmt::format("M{0},{2}A{3},{4} 0 0 1 {1},{2}A{3},{4} 0 0 1 {0},{2}Z", x - rx, x + rx, y, rx, ry);
  }

  std::string rectangle(const Element& e) const {
    const double x = length(e, "x", 0), y = length(e, "y", 1);
    const double w = length(e, "width", 0), h = length(e, "height", 1);
    if (!(w > 0 && h > 0)) return "";
    double rx = length(e, "rx", 0, -1), ry = length(e, "ry", 1, -1);
    if (rx < 0) rx = std::max(ry, 0.0);
    if (ry < 0) ry = rx;
    rx = std::min(rx, w / 2);
    ry = std::min(ry, h / 2);
    if (!(rx > 0 && ry > 0)) return fmt::format("M{},{}h{}v{}h{}Z", x, y, w, h, -w);
    return fmt::format(
        "M{0},{1}h{2}a{4},{5} 0 0 1 {4},{5}v{3}a{4},{5} 0 0 1 {6},{5}h{7}a{4},{5} 0 0 1 {6},{8}v{9}"
        "a{4},{5} 0 0 1 {4},{8}Z",
        x + rx, y, w - 2 * rx, h - 2 * ry, rx, ry, -rx, 2 * rx - w, -ry, 2 * ry - h);
  }

  const Elements& elements_;
  const Element& root_;
  StyleSheet styles_;
  std::vector<double> view_box_;
  Vec2 page_ = Vec2(100, 100);
  std::vector<Pending> pending_;
  std::size_t data_ = 0;  // of the shapes so far, bytes
};

}  // namespace

Drawing drawing_of(const Elements& elements) {
  if (elements.empty() || local_name(elements.front()) != "svg")
    throw Error(ErrorCode::input, fmt::format("it is no SVG: its root element is <{}>, not <svg>",
                                              elements.empty() ? "" : elements.front().name));
  Walker walker(elements);
  Drawing drawing;
  if (const auto scale = walker.physical_scale()) {
    drawing.mm_per_unit = *scale;
    drawing.physical = true;
  }
  const std::vector<Pending> pending = walker.shapes();
  // Once coarsely, to learn how large the drawing is.
  Eigen::AlignedBox2d box;
  for (const Pending& shape : pending) {
    for (const Ring& ring : flatten_path(shape.data, shape.state.transform, 1e300)) {
      for (const Vec2& p : ring) box.extend(p);
    }
  }
  const double tolerance = box.isEmpty() ? 1.0 : 1e-4 * box.diagonal().norm();
  for (const Pending& shape : pending) {
    std::vector<Ring> rings = flatten_path(shape.data, shape.state.transform, tolerance);
    if (rings.empty()) continue;
    drawing.shapes.push_back({std::move(rings), shape.state.even_odd, shape.state.paint,
                              shape.state.opacity * shape.state.fill_opacity, shape.state.blurred});
  }
  return drawing;
}

}  // namespace wilt::svg
