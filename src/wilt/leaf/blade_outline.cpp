#include "wilt/leaf/blade_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/leaf/curves.hpp"
#include "wilt/leaf/presets.hpp"
#include "wilt/leaf/rings.hpp"
#include "wilt/leaf/teeth.hpp"

namespace wilt {
namespace {

using namespace detail;

constexpr int kPointsPerSpan = 24;
constexpr double kToothScatter = 0.012;  // of a single tooth's place, in units of its lobe's vein

// Two numbers in an order of ours: arguments of one call are evaluated in the compiler's.
Vec2 normal_pair(Random& random) {
  const double y = random.normal(), x = random.normal();
  return {x, y};
}

// One side of the margin, from the petiole to the apex.
struct Side {
  Polyline points;
  std::vector<std::size_t> tips;  // indices into points; the apex is the last
  std::vector<std::size_t>
      turns;  // where the margin turns from rising to falling: sinuses and tips, in order
};

// The nodes of one side in the plane of the leaf, each lobe turned and stretched a little at random.
std::vector<MarginNode> scatter_nodes(const OutlineRule& rule, Random& random) {
  std::vector<MarginNode> nodes;
  for (std::size_t k = 0; k < rule.lobes.size(); ++k) {
    const LobeNodes& lobe = rule.lobes[k];
    const bool apical = k + 1 == rule.lobes.size();
    const double angle = lobe.angle + (apical ? 0.0 : 1.2 * rule.vary * random.normal());
    const double length = lobe.length * (apical ? 1.0 : 1.0 + rule.vary * random.normal());
    const double width = lobe.length * (1.0 + rule.vary * random.normal());
    const Vec2 along(std::sin(angle), std::cos(angle));
    const Vec2 across(std::cos(angle), -std::sin(angle));
    for (MarginNode node : lobe.nodes) {
      if (node.kind == NodeKind::tooth) {
        node.at += kToothScatter * normal_pair(random);
      }
      node.at = width * node.at.x() * across + length * node.at.y() * along;
      nodes.push_back(node);
    }
  }
  return nodes;
}

// Splines between the corners (tips and teeth); through the sinuses the margin is smooth.
Side draw_side(const std::vector<MarginNode>& nodes) {
  Side side;
  Polyline piece;
  std::vector<std::size_t> sinuses;  // indices into piece
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    piece.push_back(nodes[i].at);
    if (nodes[i].kind == NodeKind::sinus) sinuses.push_back(piece.size() - 1);
    const bool corner = nodes[i].kind == NodeKind::tip || nodes[i].kind == NodeKind::tooth;
    if (!corner && i + 1 < nodes.size()) continue;
    const Polyline curve = spline_through(piece, kPointsPerSpan);
    const std::size_t offset = side.points.empty() ? 0 : side.points.size() - 1;
    for (const std::size_t s : sinuses) side.turns.push_back(offset + s * kPointsPerSpan);
    side.points.insert(side.points.end(), curve.begin() + (offset > 0 ? 1 : 0), curve.end());
    if (nodes[i].kind == NodeKind::tip) {
      side.tips.push_back(side.points.size() - 1);
      side.turns.push_back(side.points.size() - 1);
    }
    piece.assign(1, nodes[i].at);
    sinuses.clear();
  }
  return side;
}

// Teeth on every run between a sinus and a tip. The side runs counter-clockwise, so outwards is right.
Side with_teeth(const Side& side, const TeethRule& rule, Random& random) {
  if (rule.pitch == 0.0) return side;
  Side result;
  result.points.push_back(side.points.front());
  for (std::size_t k = 0; k + 1 < side.turns.size(); ++k) {
    const auto begin = side.points.begin() + static_cast<std::ptrdiff_t>(side.turns[k]);
    const auto end = side.points.begin() + static_cast<std::ptrdiff_t>(side.turns[k + 1]) + 1;
    Polyline run(begin, end);
    const bool to_tip = std::count(side.tips.begin(), side.tips.end(), side.turns[k + 1]) > 0;
    if (!to_tip) std::reverse(run.begin(), run.end());
    run = add_teeth(run, to_tip ? 1.0 : -1.0, rule, random);
    if (!to_tip) std::reverse(run.begin(), run.end());
    result.points.insert(result.points.end(), run.begin() + 1, run.end());
    if (to_tip) result.tips.push_back(result.points.size() - 1);
  }
  return result;
}

// The smooth deformation that makes one leaf differ from the next: an oblique base, a bent midrib,
// undulation.
class Individual {
 public:
  Individual(const OutlineRule& rule, Random& random) {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    oblique_ = side * rule.asymmetry * random.uniform(0.6, 1.3);
    bend_ = rule.bend * random.normal();
    for (Wave& wave : waves_) {
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double length = random.uniform(0.22, 0.6);
      wave.vector = 2.0 * std::numbers::pi / length * Vec2(std::cos(angle), std::sin(angle));
      wave.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      wave.amplitude = rule.wave * normal_pair(random) / std::sqrt(double(waves_.size()));
    }
  }

  Vec2 operator()(const Vec2& p) const {
    const double low = std::clamp(1.0 - p.y() / 0.6, 0.0, 1.0);
    Vec2 q = p;
    q.x() += oblique_ * low * std::abs(p.x()) + bend_ * p.y() * (p.y() - 1.0);
    q.y() -= 0.5 * oblique_ * low * p.x();
    for (const Wave& wave : waves_) q += wave.amplitude * std::sin(wave.vector.dot(p) + wave.phase);
    return q;
  }

 private:
  struct Wave {
    Vec2 vector, amplitude;
    double phase = 0.0;
  };
  double oblique_ = 0.0, bend_ = 0.0;
  std::array<Wave, 8> waves_;
};

std::size_t nearest_index(const Polyline& ring, const Vec2& point) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if ((ring[i] - point).squaredNorm() < (ring[best] - point).squaredNorm()) best = i;
  }
  return best;
}

// Rounds tips and teeth, then puts the petiole at the origin and the apex on the y axis.
BladeOutline finish(Polyline ring, const Polyline& tips, std::size_t apex, double blunt) {
  constexpr int kSteps = 4;  // per standard deviation of the smoothing
  const double step = std::max(blunt, 0.001) / kSteps;
  ring = resample_ring(ring, static_cast<int>(std::ceil(length_of(ring, true) / step)));
  std::vector<std::size_t> tip_indices;
  for (const Vec2& tip : tips) tip_indices.push_back(nearest_index(ring, tip));
  if (blunt > 0.0) smooth_ring(ring, 2 * kSteps * kSteps);
  const Vec2 axis = (ring[tip_indices[apex]] - ring[0]).normalized();
  const Vec2 origin = ring[0];
  BladeOutline blade;
  blade.outline.margin.resize(static_cast<Eigen::Index>(ring.size()), 2);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i] - origin;
    blade.outline.margin.row(static_cast<Eigen::Index>(i)) << -cross(axis, p), axis.dot(p);
  }
  blade.petiole = Vec2::Zero();
  for (const std::size_t i : tip_indices) {
    blade.tips.push_back(blade.outline.margin.row(static_cast<Eigen::Index>(i)).transpose());
  }
  std::reverse(blade.tips.begin(), blade.tips.end());
  return blade;
}

BladeOutline draw_blade(const OutlineRule& rule, std::uint64_t seed) {
  Random random(seed, "blade outline");
  const Individual individual(rule, random);
  Polyline ring, tips;
  std::size_t apex = 0;
  for (const bool right : {true, false}) {
    Side side = with_teeth(draw_side(scatter_nodes(rule, random)), rule.teeth, random);
    for (Vec2& p : side.points) p = individual(right ? p : Vec2(-p.x(), p.y()));
    if (right) {
      ring = side.points;
      for (const std::size_t i : side.tips) tips.push_back(side.points[i]);
      apex = tips.size() - 1;
    } else {
      ring.insert(ring.end(), side.points.rbegin() + 1, side.points.rend() - 1);
      for (std::size_t k = side.tips.size() - 1; k-- > 0;) tips.push_back(side.points[side.tips[k]]);
    }
  }
  return finish(std::move(ring), tips, apex, rule.blunt);
}

}  // namespace

BladeOutline blade_outline(std::string_view species_name, std::uint64_t seed) {
  OutlineRule rule = preset(species_name).outline;
  if (rule.lobes.empty()) {
    throw Error(
        ErrorCode::input,
        fmt::format("the preset '{}' has no outline of its own: name one of the six species", species_name));
  }
  // A rare individual whose lobes run into each other is drawn again, nearer to the type.
  for (int attempt = 0; attempt < 4; ++attempt) {
    BladeOutline blade = draw_blade(rule, seed);
    if (!find_crossing(rings_of(blade.outline))) return blade;
    rule.vary *= 0.5;
    rule.wave *= 0.5;
  }
  throw std::logic_error(fmt::format("the preset '{}' draws a margin that crosses itself", species_name));
}

}  // namespace wilt
