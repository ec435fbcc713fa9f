// The colours that a clip shows, for formats whose readers do not multiply a texture by vertex colours.
#pragma once

#include <optional>
#include <string>

#include "wilt/core/image.hpp"
#include "wilt/output/clip.hpp"
#include "wilt/simulation/uv_raster.hpp"

namespace wilt {

/// Texture x vertex colour of a clip, frame by frame. Refers to the clip, which must outlive it.
///
/// Deterministic on any number of threads.
class ShownColours {
 public:
  /// Throws Error{input} when the clip's texture is neither PNG nor JPEG. O(texels).
  explicit ShownColours(const Clip& clip);

  const Clip& clip() const { return clip_; }
  int last_frame() const { return static_cast<int>(clip_.frames.size()) - 1; }

  /// Linear RGB of the blade at a frame, #V x 3: the mean of the texture around each vertex times its colour.
  Points3 blade(int frame) const;
  /// Linear RGB of the stalk at a frame; white when the clip says nothing.
  Vec3 stalk(int frame) const;

  /// A JPEG of the texture as it looks at a frame, texel by texel; empty when the clip has none. Where the
  /// skin cannot carry a texture of its own (uv_raster.hpp) every texel takes the mean of the vertex colours.
  /// O(texels).
  std::string texture(int frame) const;

 private:
  Points3 vertex_colours(int frame) const;
  Points3 means_around_vertices() const;
  int vertex(int face, int corner) const;

  const Clip& clip_;
  Image picture_;                   // square; empty: white
  std::optional<UvRaster> raster_;  // as large as the picture
  Points3 around_;                  // #V x 3, linear: the texture around each vertex
};

/// Writes the texture of the last frame and the normal map beside `path`, NAME.texture.jpg and
/// NAME.normal.jpg
/// (.png where the clip's is one): the same bytes for every format that refers to them. Returns the
/// file's path; empty when the clip has none.
std::string write_texture(const std::string& path, const ShownColours& shown, int frame);
std::string write_normal_map(const std::string& path, const Clip& clip);

}  // namespace wilt
