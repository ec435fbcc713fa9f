// A smooth surface through noisy points. Inside the import room only.
#pragma once

#include "wilt/core/types.hpp"

namespace wilt::detail {

/// A surface X(u, v) of bicubic B-splines on an even grid, that minimises
///     1/N sum_i w_i |X(u_i, v_i) - p_i|^2 + lambda integral |X_uu|^2 + 2 |X_uv|^2 + |X_vv|^2
/// (P-splines with the thin plate's penalty: Eilers and Marx 1996, Wahba 1990). lambda by generalised
/// cross-validation (Craven and Wahba 1979) with the trace counted twice, because errors of neighbours in a
/// scan go together and would be taken for relief (a factor of 1.4 is usual: Kim and Gu 2004); the trace is
/// estimated with random signs (Hutchinson 1990). The weights are Tukey's, of the distance over its median.
class SmoothSurface {
 public:
  /// Fits points (#P x 3) at uv (#P x 2), some `knot_spacing` between knots or more: 4000 coefficients at
  /// most. Then moves every uv to the nearest place of the surface and fits again. Deterministic.
  SmoothSurface(Points2 uv, const Points3& points, double knot_spacing);

  Vec3 at(const Vec2& uv) const;

  const Points2& uv() const { return uv_; }  ///< #P x 2, as moved
  double noise() const { return noise_; }    ///< root mean square distance of the points that are no outliers
  double outliers() const { return outliers_; }  ///< the share of points that weigh nothing

 private:
  struct Place;
  struct Fit;
  Place locate(const Vec2& uv) const;
  void fit(const Points3& points, bool choose_lambda);
  void project(const Points3& points);

  Points2 uv_;
  Vec2 origin_ = Vec2::Zero();
  double step_ = 1.0;
  int columns_ = 0, rows_ = 0;  // of coefficients
  Points3 coefficients_;
  double lambda_ = 1e-4;
  double noise_ = 0.0, outliers_ = 0.0;
};

}  // namespace wilt::detail
