// glTF binary (GLB): the withering leaf as morph targets with the animation that plays them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/output/clip.hpp"

namespace wilt {

struct GlbOptions {
  double seconds = 4.0;   ///< length of the clip, > 0; time is proportional to the iteration
  int stalk_sides = 10;   ///< corners per ring of the stalk, 3 to 64
  int max_morphs = 0;     ///< frames at most, 2 or more, chosen by choose_frames() (frame_choice.hpp); 0: all
  void validate() const;  ///< throws Error{configuration}
};

/// The clip as bytes of a glTF 2.0 binary.
///
/// Nodes "blade" (the leaf's skin: POSITION, NORMAL, TEXCOORD_0, COLOR_0 linear, _WATER = w / m at the last
/// frame) and "stalk" (a tube, when the leaf has one). Of several frames each is a morph target (POSITION,
/// NORMAL and, given colours per frame, COLOR_0; sparse where that is smaller), and there is one animation of
/// their weights, linear between one-hot keys: playing it is piecewise linear between frames. The base has
/// the shape of the first frame and the colours of the last one, which readers without colour morphs show;
/// the default weights show the last. Coordinates as in coordinates.hpp. asset.extras.wilt: version, config,
/// leaf, units, metres_per_unit, up, frames (iterations), dryness (mean, per frame), veins (order, positions,
/// and the face of the blade and the barycentric coordinates of every point, so that they can follow the
/// blade), and left_out where frames were (of: their number in the clip; rms and largest deviation in
/// metres). The same clip gives the same bytes. Throws Error{output} above the 4 GB of the format,
/// std::logic_error for wrong sizes or positions that are not finite. O(#frames #V).
std::string glb_bytes(const Clip& clip, const GlbOptions& options = {});

/// The same into a file, by write_file().
void write_glb(const std::string& path, const Clip& clip, const GlbOptions& options = {});

/// A mesh of a GLB that wilt wrote; every frame as absolute values. Coordinates of the file, Y up.
struct GlbMesh {
  std::string name;              ///< "blade" or "stalk"
  std::vector<Points3> frames;   ///< positions, #S x 3 each
  std::vector<Points3> normals;  ///< #S x 3 each
  std::vector<Points3> colours;  ///< linear, #S x 3: none, one, or one per frame
  Points2 uv;                    ///< #S x 2, or empty
  Eigen::VectorXd water;         ///< #S, w / m at the last frame, or empty
  Faces faces;                   ///< #F x 3
};

struct GlbVein {
  int order = 1;
  Points3 positions;       ///< #P x 3, at rest, coordinates of the file
  std::vector<int> faces;  ///< #P, rows of the blade's faces
  Points3 barycentric;     ///< #P x 3
};

struct GlbFile {
  std::vector<GlbMesh> meshes;  ///< the blade, then the stalk if there is one
  std::vector<double> times;    ///< seconds, one per frame (one frame: 0)
  std::vector<int> iterations;  ///< one per frame
  std::vector<double> dryness;  ///< mean over the blade, 0 to 1, one per frame
  std::vector<GlbVein> veins;
  std::string texture;         ///< bytes of a PNG or JPEG that multiplies the blade's colours
  std::string normal_texture;  ///< the same of its normal map, or empty
  std::string generator;       ///< "wilt 0.1.0"
  std::string extras;          ///< JSON text of asset.extras.wilt
};

/// Reads what write_glb() wrote. Throws Error{input}, naming `name` (the path), for anything else.
GlbFile parse_glb(std::string_view bytes, const std::string& name);
GlbFile read_glb(const std::string& path);

}  // namespace wilt
