// Point caches: PC2 and MDD, the positions of a mesh frame by frame and nothing else.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/output/clip.hpp"
#include "wilt/output/clip_options.hpp"

namespace wilt {

// They play on a mesh that another file brings in: the points are those of the OBJ that wilt writes, in its
// order (the blade's mesh vertices; the stalk's points), and in its coordinates (coordinates.hpp: Y up,
// turned for no program). A GLB of a leaf whose texture coordinates have no seams, as those of every built-in
// species, has the same blade vertices in the same order.
//
// In Blender: import the OBJ as it is (the importer turns the object, not its points), give the blade a Mesh
// Cache modifier with the cache, and leave its axes alone (forward Y, up Z, no flip). MDD: time mode Time.
// PC2: Blender counts in samples, so time mode Frame with frame scale (frames - 1) / (seconds x frames per
// second).

/// Points over time.
struct PointTrack {
  std::vector<double> times;  ///< seconds, ascending, the first is 0
  int points = 0;
  std::function<Points3(int frame)> positions;  ///< points x 3, coordinates of the file
};

/// Of the blade's mesh vertices, and of the stalk's tube (no times when there is none). Both refer to the
/// clip.
PointTrack blade_track(const Clip& clip, const ClipOptions& options);
PointTrack stalk_track(const Clip& clip, const ClipOptions& options);

/// PC2 (3ds Max, Blender, Houdini): little-endian, "POINTCACHE2", version 1, the start 0 and the rate in
/// frames per sample at `frame_rate`; as many samples as frames. Samples are even in time: between frames
/// that are not, they are interpolated linearly. O(#frames #V).
std::string pc2_bytes(const PointTrack& track, double frame_rate);

/// MDD (LightWave, Blender, three.js): big-endian, the time of every frame in seconds.
std::string mdd_bytes(const PointTrack& track);

/// What the head of a PC2 or MDD says.
struct PointCacheHead {
  int points = 0, frames = 0;
  double length = 0.0;  ///< of the clip: MDD in seconds, PC2 in frames of the scene
};

/// Reads a head by the extension of `path`, which names the file in messages. Throws Error{input} when the
/// bytes are not such a file's.
PointCacheHead parse_point_cache(std::string_view bytes, const std::string& path);

/// By the extension, PC2 or MDD, of the blade; of the stalk, if there is one, into NAME.stalk.pc2 or
/// NAME.stalk.mdd. By write_file().
void write_point_caches(const std::string& path, const Clip& clip, const ClipOptions& options = {});

}  // namespace wilt
