#include "wilt/import/svg_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"
#include "wilt/import/regions.hpp"

namespace wilt::detail {
namespace {

// One connected filled area of a shape.
struct Candidate {
  Outline outline;
  double area = 0.0;
  Eigen::AlignedBox2d box;
  int shape = 0;
  bool grey = false, faint = false;

  double size() const { return std::sqrt(area); }
};

constexpr std::size_t kMostCandidates = 100;
constexpr double kLeastLeaf = 0.03;  // area of a leaf, in units of the largest leaf's
constexpr double kMostStalk = 0.3;   // area of a stalk, in units of its leaf's

bool is_grey(const svg::Paint& paint) {
  if (paint.kind != svg::Paint::Kind::colour) return false;
  const double high = std::max({paint.red, paint.green, paint.blue});
  return high - std::min({paint.red, paint.green, paint.blue}) < 0.12 && high < 0.85;
}

std::vector<Candidate> candidates_of(const svg::Drawing& drawing, const RegionGrid& grid) {
  std::vector<Candidate> all;
  for (std::size_t s = 0; s < drawing.shapes.size(); ++s) {
    const svg::Shape& shape = drawing.shapes[s];
    for (Outline& outline : grid.fill(shape.rings, shape.even_odd)) {
      Candidate candidate;
      candidate.area = area_of(outline);
      for (int i = 0; i < outline.margin.rows(); ++i)
        candidate.box.extend(Vec2(outline.margin.row(i).transpose()));
      candidate.outline = std::move(outline);
      candidate.shape = static_cast<int>(s);
      candidate.grey = is_grey(shape.paint);
      candidate.faint = shape.blurred || shape.opacity < 0.5;
      all.push_back(std::move(candidate));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
  if (all.size() > kMostCandidates) all.resize(kMostCandidates);
  return all;
}

// Much the same shape, perhaps a little moved.
bool similar(const Candidate& a, const Candidate& b, double share, double shift) {
  const Vec2 sa = a.box.sizes(), sb = b.box.sizes();
  return std::abs(a.area - b.area) <= share * std::max(a.area, b.area) &&
         (sa - sb).cwiseAbs().maxCoeff() <= share * std::max(sa.maxCoeff(), sb.maxCoeff()) &&
         (a.box.center() - b.box.center()).norm() <= shift * a.box.diagonal().norm();
}

bool is_background(const Candidate& c, const std::vector<Candidate>& all) {
  if (c.area < 0.995 * c.box.volume() || all.size() < 2) return false;
  Eigen::AlignedBox2d grown = c.box;
  const Vec2 slack = 0.01 * c.box.sizes();
  grown.extend(Vec2(c.box.min() - slack));
  grown.extend(Vec2(c.box.max() + slack));
  return std::all_of(all.begin(), all.end(), [&](const Candidate& o) { return grown.contains(o.box); });
}

bool is_shadow(const Candidate& c, const std::vector<Candidate>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Candidate& o) {
    if (o.shape == c.shape || o.faint) return false;
    if (c.faint) return o.area > 0.3 * c.area;
    return c.grey && !o.grey && o.shape > c.shape && similar(c, o, 0.25, 0.2);
  });
}

// Thin for its outline's length: a strip is 4 where it is 12 times as long as wide.
bool is_stalk_like(const Candidate& c) {
  double length = 0.0;
  const Points2& m = c.outline.margin;
  for (int i = 0; i < m.rows(); ++i) length += (m.row(i) - m.row((i + 1) % m.rows())).norm();
  return length * length / (4 * std::numbers::pi * c.area) > 4.0;
}

double gap_between(const Candidate& a, const Candidate& b, Vec2& nearest_of_a) {
  double least = 1e300;
  for (int i = 0; i < a.outline.margin.rows(); ++i) {
    for (int j = 0; j < b.outline.margin.rows(); ++j) {
      const double d = (a.outline.margin.row(i) - b.outline.margin.row(j)).norm();
      if (d >= least) continue;
      least = d;
      nearest_of_a = a.outline.margin.row(i).transpose();
    }
  }
  return least;
}

// Shapes that can be leaves, largest first.
std::vector<Candidate> leaves_of(const std::vector<Candidate>& all, const RegionGrid& grid, int& shadows) {
  std::vector<Candidate> leaves;
  shadows = 0;
  for (const Candidate& c : all) {
    if (is_background(c, all)) continue;
    if (is_shadow(c, all)) {
      ++shadows;
      continue;
    }
    const bool known = std::any_of(leaves.begin(), leaves.end(), [&](const Candidate& leaf) {
      if (c.area < kLeastLeaf * leaf.area || similar(c, leaf, 0.1, 0.05)) return true;
      if (!leaf.box.intersects(c.box)) return false;
      return grid.overlap(c.outline, leaf.outline) > 0.5 * c.area;
    });
    const bool stalk =
        is_stalk_like(c) && std::any_of(leaves.begin(), leaves.end(), [&](const Candidate& leaf) {
          Vec2 foot;
          return c.area < kMostStalk * leaf.area && gap_between(leaf, c, foot) < 0.1 * leaf.size();
        });
    if (!known && !stalk) leaves.push_back(c);
  }
  return leaves;
}

// A stalk drawn as a shape of its own: joined where it overlaps the leaf, else a pointer to the petiole.
void join_stalk(const Candidate& leaf, const std::vector<Candidate>& all, const RegionGrid& grid,
                ChosenLeaf& chosen) {
  for (const Candidate& c : all) {
    if (c.area > kMostStalk * leaf.area || c.area < 0.002 * leaf.area || !is_stalk_like(c) ||
        is_shadow(c, all))
      continue;
    if (grid.overlap(c.outline, leaf.outline) > 0.5 * c.area) continue;  // a vein
    Vec2 foot;
    const double gap = gap_between(leaf, c, foot);
    const std::vector<Outline> together = grid.unite(chosen.outline, c.outline);
    if (area_of(together.front()) > area_of(chosen.outline) + 0.3 * c.area) {
      chosen.outline = together.front();
      chosen.notes.push_back("the stalk, a shape of its own, was joined to the blade");
      return;
    }
    if (gap < 0.03 * leaf.size()) {
      chosen.stalk_foot = foot;
      return;
    }
  }
}

}  // namespace

ChosenLeaf choose_leaf(const svg::Drawing& drawing, int nth) {
  Eigen::AlignedBox2d box;
  for (const svg::Shape& shape : drawing.shapes) {
    for (const svg::Ring& ring : shape.rings) {
      for (const Vec2& p : ring) box.extend(p);
    }
  }
  if (box.isEmpty())
    throw Error(
        ErrorCode::input,
        "the drawing has no filled path, polygon, rectangle, circle or ellipse; a leaf is the largest "
        "filled shape, so give its outline a fill");
  const RegionGrid grid(box.min(), box.max());
  const std::vector<Candidate> all = candidates_of(drawing, grid);
  int shadows = 0;
  const std::vector<Candidate> leaves = leaves_of(all, grid, shadows);
  if (leaves.empty())
    throw Error(
        ErrorCode::input,
        "no filled shape of the drawing encloses an area; a leaf is the largest filled shape, so draw "
        "its whole outline");
  if (nth > static_cast<int>(leaves.size()))
    throw Error(ErrorCode::input,
                fmt::format("the drawing has {} leaf-like shape{}; --leaf {} must be from 1 "
                            "to {}",
                            leaves.size(), leaves.size() == 1 ? "" : "s", nth, leaves.size()));
  const Candidate& leaf = leaves[nth - 1];
  ChosenLeaf chosen;
  chosen.outline = leaf.outline;
  if (leaves.size() > 1)
    chosen.notes.push_back(
        fmt::format("the drawing has {} leaf-like shapes; number {} by area was taken "
                    "(--leaf N takes another)",
                    leaves.size(), nth));
  if (shadows > 0) chosen.notes.push_back("shadows were left out");
  join_stalk(leaf, all, grid, chosen);
  return chosen;
}

}  // namespace wilt::detail
