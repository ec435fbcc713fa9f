#include "wilt/render/refine.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace wilt {
namespace {

using Key = std::uint64_t;

Key key(int a, int b) {
  return (Key(std::uint32_t(a)) << 32) | std::uint32_t(b);
}

// One number for all vertices at one place.
std::vector<int> welded(const Points3& positions) {
  std::map<std::array<double, 3>, int> seen;
  std::vector<int> same(static_cast<std::size_t>(positions.rows()));
  for (int v = 0; v < positions.rows(); ++v)
    same[std::size_t(v)] =
        seen.try_emplace({positions(v, 0), positions(v, 1), positions(v, 2)}, v).first->second;
  return same;
}

// The vertices before and after each margin vertex, or -1.
struct Margin {
  std::vector<int> before, after;
};

Margin margin_of(const std::vector<int>& same, const Faces& faces) {
  std::unordered_map<Key, int> sides;
  for (int f = 0; f < faces.rows(); ++f)
    for (int i = 0; i < 3; ++i)
      ++sides[key(same[std::size_t(faces(f, i))], same[std::size_t(faces(f, (i + 1) % 3))])];
  Margin margin{std::vector<int>(same.size(), -1), std::vector<int>(same.size(), -1)};
  for (int f = 0; f < faces.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int a = same[std::size_t(faces(f, i))], b = same[std::size_t(faces(f, (i + 1) % 3))];
      if (sides.count(key(b, a)) > 0) continue;
      margin.after[std::size_t(a)] = b;
      margin.before[std::size_t(b)] = a;
    }
  }
  return margin;
}

class Refinement {
 public:
  explicit Refinement(Surface& surface)
      : surface_(surface),
        same_(welded(surface.positions)),
        margin_(margin_of(same_, surface.faces)),
        count_(static_cast<int>(surface.positions.rows())) {}

  void run() {
    const Faces coarse = surface_.faces;
    Faces fine(4 * coarse.rows(), 3);
    for (int f = 0; f < coarse.rows(); ++f) {
      int middle[3];
      for (int i = 0; i < 3; ++i) middle[i] = split(coarse(f, i), coarse(f, (i + 1) % 3));
      for (int i = 0; i < 3; ++i) fine.row(4 * f + i) << coarse(f, i), middle[i], middle[(i + 2) % 3];
      fine.row(4 * f + 3) << middle[0], middle[1], middle[2];
    }
    append(surface_.positions, [this](int a, int b) { return position(a, b); });
    append(surface_.normals, [this](int a, int b) -> Vec3 {
      return (surface_.normals.row(a) + surface_.normals.row(b)).transpose().normalized();
    });
    const auto append_mean = [this](auto& values) {
      append(values,
             [&values](int a, int b) { return (0.5 * (values.row(a) + values.row(b))).transpose().eval(); });
    };
    append_mean(surface_.colours);
    append_mean(surface_.uv);
    append_mean(surface_.rest);
    append_mean(surface_.water);
    surface_.faces = std::move(fine);
  }

 private:
  int split(int a, int b) {
    const auto [entry, is_new] = middles_.try_emplace(key(std::min(a, b), std::max(a, b)), count_);
    if (is_new) {
      ends_.push_back({std::min(a, b), std::max(a, b)});
      ++count_;
    }
    return entry->second;
  }

  template <class Rows, class Value>
  void append(Rows& values, const Value& value) {
    if (values.rows() == 0) return;
    Rows all(count_, values.cols());
    all.topRows(values.rows()) = values;
    for (std::size_t i = 0; i < ends_.size(); ++i)
      all.row(values.rows() + int(i)) = value(ends_[i].first, ends_[i].second).transpose();
    values = std::move(all);
  }

  Vec3 at(int v) const { return surface_.positions.row(v).transpose(); }

  Vec3 position(int a, int b) const {
    const Vec3 pa = at(a), pb = at(b), along = pb - pa;
    const Vec3 na = surface_.normals.row(a).transpose(), nb = surface_.normals.row(b).transpose();
    const Vec3 curved = 0.5 * (pa + pb) + 0.125 * (along.dot(nb) * nb - along.dot(na) * na);
    const int wa = same_[std::size_t(a)], wb = same_[std::size_t(b)];
    if (margin_.after[std::size_t(wa)] == wb) return on_margin(wa, wb, curved);
    if (margin_.after[std::size_t(wb)] == wa) return on_margin(wb, wa, curved);
    return curved;
  }

  Vec3 on_margin(int a, int b, const Vec3& otherwise) const {
    static const double kSharp = std::cos(40.0 * std::numbers::pi / 180.0);
    const int before = margin_.before[std::size_t(a)], after = margin_.after[std::size_t(b)];
    if (before < 0 || after < 0) return otherwise;
    const Vec3 p = at(before), q = at(a), r = at(b), s = at(after);
    const auto smooth = [](const Vec3& u, const Vec3& v) { return u.dot(v) > kSharp * u.norm() * v.norm(); };
    if (!smooth(q - p, r - q) || !smooth(r - q, s - r)) return otherwise;
    return 0.5625 * (q + r) - 0.0625 * (p + s);
  }

  Surface& surface_;
  std::vector<int> same_;
  Margin margin_;
  int count_;
  std::unordered_map<Key, int> middles_;
  std::vector<std::pair<int, int>> ends_;
};

}  // namespace

void refine(Surface& surface, int levels) {
  for (int i = 0; i < levels; ++i) Refinement(surface).run();
}

std::vector<std::vector<int>> margin_loops(const Points3& positions, const Faces& faces) {
  const std::vector<int> same = welded(positions);
  Margin margin = margin_of(same, faces);
  std::vector<std::vector<int>> loops;
  for (std::size_t start = 0; start < same.size(); ++start) {
    std::vector<int> loop;
    int v = static_cast<int>(start);
    while (v >= 0 && margin.after[std::size_t(v)] >= 0) {
      loop.push_back(v);
      v = std::exchange(margin.after[std::size_t(v)], -1);
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace wilt
