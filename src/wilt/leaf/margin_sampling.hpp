// An outline as points an edge length apart. Inside the leaf room only.
#pragma once

#include <vector>

#include "wilt/leaf/curves.hpp"

namespace wilt::detail {

struct SampledMargin {
  Polyline points;                      ///< the points of all rings, one after the other
  std::vector<std::vector<int>> rings;  ///< indices into points; the margin, then the holes
  std::vector<int> kept;                ///< the points that stand for those to be kept
  double area = 0.0;                    ///< between the rings
  double length = 0.0;                  ///< of all rings
};

/// Smooths the rings at the scale of `edge` (a Gaussian of 0.6 edges times `smoothing`) and samples them
/// evenly, about an edge apart; each point of `keep` makes the nearest place of the rings a sample. Holes
/// that vanish at this scale are left out. The result does not cross itself.
SampledMargin sample_margin(const std::vector<Polyline>& rings, const Polyline& keep, double edge,
                            double smoothing);

/// Points of a hexagonal lattice of width `edge` between the rings, at least 0.45 edges from them.
Polyline hexagonal_points(const SampledMargin& margin, double edge);

}  // namespace wilt::detail
