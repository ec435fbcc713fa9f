// What a picture shows: surfaces and the light.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/core/types.hpp"

namespace wilt {

/// What labels (label_maps.hpp) call a surface.
enum class Part : std::uint8_t { background = 0, blade = 1, stalk = 2 };

/// How a surface answers light.
struct Finish {
  double translucency = 0.55;  ///< of a leaf: transmittance relative to reflectance, in [0, 1]
  double gloss = 0.7;          ///< weight of the waxy coat, in [0, 1]
  double roughness = 0.42;     ///< of the coat (GGX alpha), in [0.05, 1]
  double relief = 1.0;         ///< strength of the normal map, in [0, 4]
};

/// A triangle mesh, Z up, in the scene's unit of length.
///
/// A leaf is a thin sheet: it reflects and transmits, its underside (faces seen clockwise) is paler. A solid
/// is opaque and has one colour on both sides.
struct Surface {
  Points3 positions;  ///< #V x 3
  Points3 normals;    ///< #V x 3, or empty: computed, area-weighted
  Faces faces;        ///< #F x 3
  Points3 colours;    ///< #V x 3, linear RGB diffuse reflectance of the upper side, in [0, 1]
  Points2 uv;         ///< #V x 2, glTF convention: origin top left; needed by the maps
  Image colour_map;   ///< sRGB, multiplies the colours; may be empty
  Image normal_map;   ///< tangent space as in glTF (x along u, y against v, z out); may be empty
  bool leaf = true;
  Finish finish;

  Part part = Part::blade;  ///< of a leaf; this and the rest is for labels, not drawn
  Points3 rest;             ///< #V x 3, where the vertices are in the leaf at rest; or empty
  Eigen::VectorXd water;    ///< #V, w / m, 0 to 1; or empty
};

struct Scene {
  std::vector<Surface> surfaces;
};

inline constexpr double kSunAzimuth = 146.0 * std::numbers::pi / 180.0;   ///< radians, about Z from +x
inline constexpr double kSunElevation = 38.0 * std::numbers::pi / 180.0;  ///< radians, above the horizon
/// The unit vector towards a sun there.
Vec3 sun_direction(double azimuth, double elevation);

/// A distant disc.
struct Sun {
  Vec3 direction = {-0.65329, 0.44065, 0.61566};  ///< towards the sun; any length but 0
  double radius = 0.035;                          ///< angular, radians, in [0, 0.5]; the real one has 0.0047
  Vec3 irradiance = {8.8, 7.4, 5.7};              ///< on a plane that faces it, linear RGB
};

/// A dome whose radiance changes linearly with the sine of the elevation between three heights.
struct Sky {
  Vec3 zenith = {0.44, 0.54, 0.71};
  Vec3 horizon = {0.58, 0.60, 0.63};
  Vec3 nadir = {0.38, 0.34, 0.29};

  Vec3 radiance(const Vec3& unit_direction) const;
  /// What a white horizontal plane under the open sky reflects: its irradiance / pi.
  Vec3 mean_above() const;
};

struct Lighting {
  Sun sun;
  Sky sky;
};

/// Every position of the scene, #P x 3.
Points3 scene_points(const Scene& scene);

/// Throws Error{input} that names the first surface that cannot be drawn and why; an empty scene too.
void validate(const Scene& scene);

}  // namespace wilt
