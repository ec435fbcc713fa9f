// The colours of a photographed leaf, and how they age: the state that the photo shows goes on from there.
#pragma once

#include <Eigen/Core>

#include "wilt/core/image.hpp"
#include "wilt/simulation/blade_texels.hpp"
#include "wilt/simulation/senescence.hpp"

namespace wilt {

/// What a photo shows around each vertex, and the state of the species' tissue that looks most like it. #V.
struct PhotoTissue {
  Points3 colour;           ///< linear RGB, mean of the texels around, above 0
  Points3 brightest;        ///< the same of the bright ones among them (veins), a little less
  Eigen::VectorXd age;      ///< 0 (fresh) to kOldestTissue
  Eigen::VectorXd redness;  ///< 0 to 1
};

/// `photo` has the size of the texels' raster. A place is as old as the species' tissue of nearest colour:
/// the ratio of red to green counts most, then brightness, which is the light's as well, and blue, which
/// cameras clip; the younger of two that fit alike. Where that tissue would not be red yet, `redness` is the
/// pattern's. Deterministic. O(texels + #V).
PhotoTissue photo_tissue(const BladeTexels& texels, const Image& photo, const SenescencePattern& pattern,
                         const TissueColours& colours);

/// The colours of a state, linear RGB in 0 to 1, #V x 3; dryness (#V, 0 to 1) 0 gives the photo's own.
///
/// Tissue of age a_0 at rest has the age 1 - (1 - a) (1 - a_0), a being that of senescence.hpp. Its colour is
/// M(age) q, M the species' colour and q = photo / M(a_0) what the photo has beside it: light, camera, this
/// very leaf. As the pigments go, the hue of q goes too, and its brightness to a part.
Points3 aged_colours(const PhotoTissue& tissue, const SenescencePattern& pattern,
                     const TissueColours& colours, const Eigen::VectorXd& dryness);

/// How much of the photo's hue is gone at a state, 0 to 1, #V; 0 at rest.
Eigen::VectorXd faded_hue(const SenescencePattern& pattern, const Eigen::VectorXd& dryness);

/// The vertex colours of a clip's first frame and the mean colours of its texture, linear RGB, #V x 3.
struct PhotoLevels {
  Points3 first, texture;
};

/// The texture that times `first` (interpolated) is the photo, within two steps of 255 (blue: six). Within
/// those limits it has around each vertex the mean colour `texture`, and the photo's detail: in each channel,
/// and where its hue has faded (#V) that of green, which cameras see best, in all. Every texel is filled.
/// Deterministic.
Image photo_texture(const BladeTexels& texels, const Image& photo, const PhotoTissue& tissue,
                    const PhotoLevels& levels, const Eigen::VectorXd& faded);

}  // namespace wilt
