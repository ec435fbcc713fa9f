// Pictures of the experiments' leaves, by the offscreen renderer.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/core/monitor.hpp"
#include "wilt/render/scene.hpp"
#include "wilt/reproduce/experiments.hpp"

namespace wilt {

struct PictureSettings {
  int width = 480, height = 360;  ///< pixels of a picture; the many small ones have half of it
  int samples = 16;               ///< per pixel
  std::uint64_t seed = 1;
};

/// One leaf at one frame (0 to Experiments::kFrames - 1).
struct Shot {
  const Experiment* experiment;
  int frame;
};

/// Renders with one look for the whole report. Deterministic.
class Pictures {
 public:
  Pictures(const PictureSettings& settings, const Monitor& monitor)
      : settings_(settings), cancel_{{}, monitor.cancelled, {}} {}

  /// Leaves on a table under one camera that sees them all; `scale` multiplies the size of the picture.
  std::vector<Image> row(const std::vector<Shot>& shots, double scale = 1.0) const;

  /// The same, close: the camera sees the vertices of `focus` in all of them.
  std::vector<Image> close_ups(const std::vector<Shot>& shots, const std::vector<VertexId>& focus) const;

  /// The leaf at its first frame from above, its primary veins drawn over it.
  Image veins(const Experiment& experiment) const;

  /// The leaf at rest from above, `values` (#V) from `least` to `most` in viridis; without light and shade,
  /// so that a colour means what the legend says.
  Image colour_map(const Subject& subject, const Eigen::VectorXd& values, double least, double most) const;

 private:
  std::vector<Image> render_all(const std::vector<Scene>& scenes, const Points3& seen, double scale) const;

  PictureSettings settings_;
  Monitor cancel_;
};

/// viridis in ten steps (matplotlib, by S. van der Walt and N. Smith, CC0), 8-bit sRGB.
inline constexpr std::array<std::array<int, 3>, 10> kViridis = {{{68, 1, 84},
                                                                 {72, 40, 120},
                                                                 {62, 74, 137},
                                                                 {49, 104, 142},
                                                                 {38, 130, 142},
                                                                 {31, 158, 137},
                                                                 {53, 183, 121},
                                                                 {109, 205, 89},
                                                                 {180, 222, 44},
                                                                 {253, 231, 37}}};

/// sRGB in [0, 1], `t` clipped to [0, 1].
Vec3 viridis(double t);

}  // namespace wilt
