// What a hit looks like: normals, reflectance and transmittance of the side that is seen.
#pragma once

#include "wilt/core/types.hpp"
#include "wilt/render/rays.hpp"

namespace wilt {

/// A lit point of a thin sheet. "Front" is the side that the ray came to.
struct ShadingPoint {
  Vec3 normal;         ///< of unit length, towards the front, with the relief of the normal map
  Vec3 front, back;    ///< where rays into either side start: clear of the sheet and its facets
  Vec3 reflectance;    ///< diffuse, of the front
  Vec3 transmittance;  ///< diffuse, from the back to the front
  double gloss = 0.0, roughness = 0.4;
};

/// Reflectance and transmittance of a leaf, from the colour of its upper side.
///
/// The underside is paler; light that came through went through the pigments twice, so it is more
/// saturated and warmer. A grey leaf stays grey, and with translucency 1 and a grey of 0.5 nothing is lost.
struct SheetOptics {
  Vec3 upper, under, transmittance;
};
SheetOptics sheet_optics(const Vec3& upper_colour, double translucency);

/// What a ray meets. The maps are averaged over `footprint`, the width of the ray there in world units.
ShadingPoint shading_point(const World& world, const Ray& ray, const Hit& hit, double footprint);

}  // namespace wilt
