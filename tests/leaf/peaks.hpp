// Lobe tips as later stages find them, written independently for the tests of the outlines.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::test {

/// Prominences (in units of max d, descending) of the local maxima of the distance d from `petiole` along a
/// ring: greatest within 0.03 of the perimeter to either side. A maximum without a higher one anywhere
/// counts 1.
inline std::vector<double> prominences(const std::vector<Vec2>& ring, const Vec2& petiole) {
  const auto n = static_cast<int>(ring.size());
  std::vector<double> s(ring.size() + 1, 0.0), d(ring.size());
  const auto at = [&](int i) { return static_cast<std::size_t>((i % n + n) % n); };
  for (int i = 0; i < n; ++i) {
    d[at(i)] = (ring[at(i)] - petiole).norm();
    s[at(i) + 1] = s[at(i)] + (ring[at(i + 1)] - ring[at(i)]).norm();
  }
  const double top = *std::max_element(d.begin(), d.end());
  std::vector<double> result;
  for (int i = 0; i < n; ++i) {
    if (d[at(i - 1)] > d[at(i)] || d[at(i + 1)] > d[at(i)]) continue;
    bool greatest = true;
    double deepest[2] = {d[at(i)], d[at(i)]};
    bool higher[2] = {false, false};
    for (const int side : {0, 1}) {
      double walked = 0.0;
      for (int k = 1; k < n && !higher[side]; ++k) {
        const std::size_t j = at(side == 0 ? i - k : i + k);
        walked += (ring[j] - ring[at(side == 0 ? i - k + 1 : i + k - 1)]).norm();
        higher[side] = d[j] > d[at(i)] || (d[j] == d[at(i)] && j < at(i));
        if (higher[side] && walked <= 0.03 * s.back()) greatest = false;
        deepest[side] = std::min(deepest[side], d[j]);
      }
    }
    if (!greatest) continue;
    if (!higher[0] && !higher[1]) {
      result.push_back(1.0);
    } else {
      result.push_back((d[at(i)] - std::max(deepest[0], deepest[1])) / top);
    }
  }
  std::sort(result.rbegin(), result.rend());
  return result;
}

inline int expected_tips(const std::string& species) {
  return species == "maple" ? 7 : species == "ivy" || species == "grape" ? 5 : 1;
}

}  // namespace wilt::test
