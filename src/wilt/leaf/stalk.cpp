// Cutting off a stalk that was drawn as part of a leaf's outline.
//
// From every point of the outline the two sides are zipped up: two fingers walk away from it in opposite
// directions, always the one whose step leaves them closer together. On a stalk they stay a stalk's width
// apart over a long way and then part suddenly, where the blade begins. The tip of a lobe or an acuminate
// apex parts steadily instead.
#include <algorithm>
#include <cmath>
#include <vector>

#include "wilt/leaf/petiole.hpp"

namespace wilt {
namespace {

// All lengths in units of sqrt(area of the outline).
constexpr double kSampling = 0.005;        // distance between samples of the outline
constexpr double kWidestStalk = 0.10;      // median width of a stalk at most
constexpr double kZipLimit = 0.22;         // the fingers stop when this far apart
constexpr double kShortestStalk = 0.12;    // length at least,
constexpr double kLeastSlenderness = 4.0;  // and in units of its width
constexpr double kFlare = 1.5;             // the blade begins where this many times the stalk's median width
constexpr double kSteadiest = 0.16;        // growth of a stalk's width per length at most
constexpr double kLeastFlare = 3.0;        // growth beyond the cut at least, in units of the growth before it

double signed_area(const Points2& ring) {
  double twice = 0.0;
  for (int i = 0, n = static_cast<int>(ring.rows()); i < n; ++i) {
    const int j = (i + 1) % n;
    twice += ring(i, 0) * ring(j, 1) - ring(i, 1) * ring(j, 0);
  }
  return twice / 2;
}

// A ring parametrised by arc length.
class ArcRing {
 public:
  explicit ArcRing(const Points2& ring) : ring_(ring), start_(ring.rows() + 1, 0.0) {
    for (int i = 0; i < size(); ++i) start_[i + 1] = start_[i] + (point(i + 1) - point(i)).norm();
  }
  int size() const { return static_cast<int>(ring_.rows()); }
  double length() const { return start_.back(); }
  double start(int i) const { return start_[i]; }
  Vec2 point(int i) const { return ring_.row(i % size()).transpose(); }
  Vec2 at(double s) const {
    s -= length() * std::floor(s / length());
    const auto after = std::upper_bound(start_.begin() + 1, start_.end() - 1, s);
    const int i = static_cast<int>(after - start_.begin()) - 1;
    const double span = start_[i + 1] - start_[i];
    const double t = span > 0 ? std::clamp((s - start_[i]) / span, 0.0, 1.0) : 0.0;
    return (1 - t) * point(i) + t * point(i + 1);
  }

 private:
  const Points2& ring_;
  std::vector<double> start_;
};

struct Rung {
  int left, right;  // samples walked to either side
  double along;     // centreline length from the start
  double width;
};

// Walks both fingers from sample `start` until they are `limit` apart; empty when they meet on the far side.
std::vector<Rung> zip_up(const std::vector<Vec2>& samples, int start, double limit) {
  const int n = static_cast<int>(samples.size());
  const auto at = [&](int i) { return samples[((start + i) % n + n) % n]; };
  std::vector<Rung> rungs{{0, 0, 0.0, 0.0}};
  Vec2 middle = at(0);
  while (true) {
    Rung next = rungs.back();
    if ((at(next.right + 1) - at(-next.left)).squaredNorm() <=
        (at(next.right) - at(-next.left - 1)).squaredNorm())
      ++next.right;
    else
      ++next.left;
    if (next.left + next.right > n / 2) return {};
    next.width = (at(next.right) - at(-next.left)).norm();
    const Vec2 centre = (at(next.right) + at(-next.left)) / 2;
    next.along += (centre - middle).norm();
    middle = centre;
    if (next.width > limit) return rungs;
    rungs.push_back(next);
  }
}

double median_width(const std::vector<Rung>& rungs, double up_to) {
  std::vector<double> widths;
  for (const Rung& rung : rungs) {
    if (rung.along <= up_to) widths.push_back(rung.width);
  }
  std::nth_element(widths.begin(), widths.begin() + widths.size() / 2, widths.end());
  return widths[widths.size() / 2];
}

// The last rung that is still stalk, or -1 when this is no stalk.
int end_of_stalk(const std::vector<Rung>& rungs, double unit, double limit) {
  if (rungs.size() < 8 || rungs.back().along < kShortestStalk * unit) return -1;
  double median = median_width(rungs, rungs.back().along);
  int cut = 0;
  for (int pass = 0; pass < 2; ++pass) {  // the second time without the flare
    cut = static_cast<int>(rungs.size()) - 1;
    while (cut > 0 && rungs[cut].width > kFlare * median) --cut;
    median = median_width(rungs, rungs[cut].along);
  }
  const double length = rungs[cut].along;
  if (median > kWidestStalk * unit || length < kShortestStalk * unit || length < kLeastSlenderness * median)
    return -1;
  // Growth of the width over the body of the stalk (without its end and its root), and beyond the cut.
  const auto width_at = [&](double along) {
    const auto it = std::lower_bound(rungs.begin(), rungs.end(), along,
                                     [](const Rung& rung, double a) { return rung.along < a; });
    return it == rungs.end() ? rungs.back().width : it->width;
  };
  const double body = (width_at(0.8 * length) - width_at(0.2 * length)) / (0.6 * length);
  const double beyond = (limit - rungs[cut].width) / std::max(rungs.back().along - length, 0.01 * unit);
  if (body > kSteadiest || beyond < kLeastFlare * std::max(body, 0.1)) return -1;
  return cut;
}

struct Candidate {
  int start = -1;
  double slenderness = 0.0;
  std::vector<Rung> rungs;  // up to the cut
};

Candidate stalk_from(const std::vector<Vec2>& samples, int start, double unit) {
  Candidate result;
  std::vector<Rung> rungs = zip_up(samples, start, kZipLimit * unit);
  if (rungs.empty()) return result;
  const int cut = end_of_stalk(rungs, unit, kZipLimit * unit);
  if (cut < 0) return result;
  rungs.resize(cut + 1);
  // Counter-clockwise samples: a sinus, zipped up along its outside, encloses a negative area.
  const int n = static_cast<int>(samples.size()), count = rungs.back().left + rungs.back().right + 1;
  Points2 part(count, 2);
  for (int i = 0; i < count; ++i) part.row(i) = samples[(start - rungs.back().left + i + n) % n].transpose();
  if (signed_area(part) <= 0) return result;
  return {start, rungs.back().along / median_width(rungs, rungs.back().along), std::move(rungs)};
}

// The most slender one, zipped up from the middle of its end.
Candidate find_stalk(const std::vector<Vec2>& samples, double unit) {
  const int n = static_cast<int>(samples.size());
  Candidate best;
  for (int start = 0; start < n; ++start) {
    Candidate candidate = stalk_from(samples, start, unit);
    if (candidate.slenderness > best.slenderness) best = std::move(candidate);
  }
  if (best.start < 0) return best;
  const int middle = best.start + (best.rungs.back().right - best.rungs.back().left) / 2;
  Candidate centred = stalk_from(samples, ((middle % n) + n) % n, unit);
  return centred.start < 0 ? best : centred;
}

}  // namespace

StalkCut cut_stalk(const Outline& outline) {
  StalkCut result;
  result.blade = outline;
  if (signed_area(outline.margin) < 0) result.blade.margin = outline.margin.colwise().reverse().eval();
  const Points2 margin = result.blade.margin;  // counter-clockwise
  const ArcRing ring(margin);
  const double unit = std::sqrt(signed_area(margin));
  if (ring.size() < 3 || !(unit > 0)) return result;

  const int count = std::clamp(static_cast<int>(ring.length() / (kSampling * unit)), 200, 4000);
  const double step = ring.length() / count;
  std::vector<Vec2> samples(count);
  for (int i = 0; i < count; ++i) samples[i] = ring.at(i * step);
  const Candidate stalk = find_stalk(samples, unit);
  if (stalk.start < 0) return result;

  const auto sample = [&](int i) { return ring.at((stalk.start + i) * step); };
  const Rung cut = stalk.rungs.back();
  const Vec2 from = sample(cut.right), to = sample(-cut.left);
  result.found = true;
  result.petiole = (from + to) / 2;

  // The blade: from the right end of the cut all the way round to its left end, and the petiole between.
  std::vector<Vec2> blade{result.petiole, from};
  const double begin = (stalk.start + cut.right) * step;
  const double end = (stalk.start - cut.left) * step + ring.length();
  const double slack = 1e-9 * ring.length();
  for (int lap = -1; lap <= 2; ++lap) {
    for (int i = 0; i < ring.size(); ++i) {
      const double s = ring.start(i) + lap * ring.length();
      if (s > begin + slack && s < end - slack) blade.push_back(ring.point(i));
    }
  }
  blade.push_back(to);
  result.blade.margin.resize(static_cast<int>(blade.size()), 2);
  for (std::size_t i = 0; i < blade.size(); ++i)
    result.blade.margin.row(static_cast<int>(i)) = blade[i].transpose();

  // From the cut to where the stalk has its width, half to three halves of it before its end.
  const int knots = 24, last = static_cast<int>(stalk.rungs.size()) - 1;
  int first = 0;
  const double width = cut.along / stalk.slenderness;
  while (first < last && stalk.rungs[first].along < 1.5 * width &&
         (stalk.rungs[first].along < 0.5 * width || stalk.rungs[first].width < 0.9 * width))
    ++first;
  std::vector<int> chosen;
  for (int k = 0; k <= knots; ++k) {
    const int rung = first + (last - first) * (knots - k) / knots;
    if (chosen.empty() || chosen.back() != rung) chosen.push_back(rung);
  }
  result.centreline.resize(static_cast<int>(chosen.size()), 2);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Rung& rung = stalk.rungs[chosen[k]];
    result.centreline.row(static_cast<int>(k)) = (sample(rung.right) + sample(-rung.left)).transpose() / 2;
    result.half_widths.push_back(rung.width / 2);
  }
  return result;
}

}  // namespace wilt
