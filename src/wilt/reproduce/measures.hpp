// Figures that the claims compare, beyond the metrics of every frame.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "wilt/reproduce/experiments.hpp"

namespace wilt {

/// The metrics at the end; not a number when the run stopped early.
struct FinalMetrics {
  double wrinkle = 0.0;  ///< of the length
  double curl = 0.0;     ///< degrees
  double area_ratio = 1.0, max_strain = 0.0;
  int self_intersections = 0;
};
FinalMetrics final_metrics(const Experiment& experiment);

/// Spearman's rank correlation with mean ranks for ties, in [-1, 1]; 0 when one side is constant.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// Cell masses at the start, #V, in the units of Table 1: a cell on a vein has mass.max.
Eigen::VectorXd first_mass(const Subject& subject, const Config& config);

/// Positions at the frame with the petiole's one-ring laid back on its rest place, in lengths, #V x 3.
Points3 in_petiole_frame(const Subject& subject, const Frame& frame);

/// How far each vertex moved in the petiole's frame, in lengths, #V.
Eigen::VectorXd displacement(const Subject& subject, const Frame& frame);

/// The share of the blade's area whose vertices satisfy `chosen`, in [0, 1].
double area_share(const Subject& subject, const std::function<bool(VertexId)>& chosen);

/// Mean of `values` (#V) over the vertices of a region.
double region_mean(const Subject& subject, const Eigen::VectorXd& values, Region region);

/// Mean over the tips of the rotation (degrees) of the normals within 0.12 L of the tip, relative to the best
/// rotation of the tissue behind it, 0.12 L to 0.30 L from the tip.
double tip_rotation_in_lobe(const Subject& subject, const Frame& frame);

/// One of the forces over the iterations, in a region (mean magnitude, working units).
std::vector<double> force_curve(const Experiment& experiment, Region region, double ForceRow::*force);

/// Local maxima from which the curve falls, on both sides, by at least `share` of its range before it rises
/// higher (or ends).
int count_waves(const std::vector<double>& curve, double share);

}  // namespace wilt
