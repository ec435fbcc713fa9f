#include "wilt/leaf/teeth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wilt::detail {
namespace {

constexpr double kPeak =
    0.72;  // where in a tooth its tip stands: the side towards the lobe's tip is the steep one
constexpr int kPointsPerTooth = 24;

struct Tooth {
  double begin, end;  // arc length
  double height;
};

// Height of a tooth of unit height at u in [0, 1].
double profile(double u, double round) {
  if (u >= kPeak) return (1.0 - u) / (1.0 - kPeak);
  const double rise = u / kPeak;
  return (1.0 - round) * rise + round * std::sin(0.5 * std::numbers::pi * rise);
}

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

std::vector<Tooth> place_teeth(double length, const TeethRule& rule, Random& random) {
  const double first = rule.start * length;
  const double last = rule.end * length;
  const int count = std::max(1, static_cast<int>(std::lround((last - first) / rule.pitch)));
  std::vector<double> ends{0.0};
  for (int k = 0; k < count; ++k) {
    const double minor = k % 2 == 1 ? 1.0 - 0.5 * rule.minor : 1.0;
    ends.push_back(ends.back() + minor * random.uniform(0.82, 1.18));
  }
  std::vector<Tooth> teeth;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    Tooth tooth;
    tooth.begin = first + (last - first) * ends[i] / ends.back();
    tooth.end = first + (last - first) * ends[i + 1] / ends.back();
    const double middle = (0.5 * (tooth.begin + tooth.end) - first) / (last - first);
    const double fade = smooth_step(0.25 + middle / 0.2) * smooth_step(0.25 + (1.0 - middle) / 0.2);
    const double minor = k % 2 == 1 ? 1.0 - rule.minor : 1.0;
    tooth.height = rule.depth * rule.pitch * fade * minor * random.uniform(0.82, 1.15);
    teeth.push_back(tooth);
  }
  return teeth;
}

}  // namespace

Polyline add_teeth(const Polyline& run, double outwards, const TeethRule& rule, Random& random) {
  const double length = length_of(run, false);
  if (length * (rule.end - rule.start) < rule.pitch) return run;
  const std::vector<Tooth> teeth = place_teeth(length, rule, random);
  const Polyline base = resample_open(run, rule.pitch / kPointsPerTooth);
  const double step = length / static_cast<double>(base.size() - 1);
  Polyline result = base;
  std::size_t j = 0;
  for (std::size_t i = 1; i + 1 < base.size(); ++i) {
    const double s = step * static_cast<double>(i);
    while (j + 1 < teeth.size() && s > teeth[j].end) ++j;
    if (s <= teeth[j].begin || s >= teeth[j].end) continue;
    const double u = (s - teeth[j].begin) / (teeth[j].end - teeth[j].begin);
    const double height = teeth[j].height * profile(u, rule.round);
    // The tangent over half a tooth, so that teeth on a bend of the margin do not fan out.
    const std::size_t reach = kPointsPerTooth / 4;
    const Vec2 tangent =
        (base[std::min(i + reach, base.size() - 1)] - base[i > reach ? i - reach : 0]).normalized();
    const Vec2 normal(outwards * tangent.y(), -outwards * tangent.x());
    result[i] += height * normal + rule.lean * height * tangent;
  }
  return result;
}

}  // namespace wilt::detail
