#include "wilt/game/animation_texture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/version.hpp"
#include "wilt/game/deep_image.hpp"
#include "wilt/game/levels_of_detail.hpp"
#include "wilt/game/texel_layout.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/glb_extras.hpp"
#include "wilt/output/glb_scene.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;
using Row = Eigen::RowVector3d;

constexpr int kMostLevels = 8;

std::string part_path(const std::string& path, const std::string& ending) {
  return beside(beside(path, ""), ending);  // without .json, then without .vat
}

std::string level_path(const std::string& path, int level) {
  return part_path(path, level == 0 ? ".rest.glb" : fmt::format(".lod{}.glb", level));
}

Json triple(const Row& row) {
  return {row[0], row[1], row[2]};
}

int vertices_of(const Moving& mesh) {
  return static_cast<int>(mesh.shape(0).positions.rows());
}

/// The clip as one list of vertices, the meshes one after the other.
struct Animation {
  std::vector<Moving> meshes;
  std::vector<int> first;  ///< vertex of each mesh
  TexelLayout layout;

  Animation(std::vector<Moving> parts, int frames) : meshes(std::move(parts)) {
    int vertices = 0;
    for (const Moving& mesh : meshes) {
      first.push_back(vertices);
      vertices += vertices_of(mesh);
    }
    layout = TexelLayout::make(vertices, frames);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      meshes[m].lookup = layout.lookup(first[m], vertices_of(meshes[m]));
  }
};

/// What a texture holds: its numbers lie between min and max where they are stored as shares of that range.
struct Track {
  std::string name, holds;
  std::function<Points3(const Moving&, int frame)> values;
  Row min, max;
};

DeepImage picture_of(const Animation& animation, const Track& track) {
  const TexelLayout& layout = animation.layout;
  DeepImage image{layout.width, layout.height, {}};
  image.texels.setZero(Eigen::Index{layout.width} * layout.height, 3);
  parallel_for(layout.frames, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      for (std::size_t m = 0; m < animation.meshes.size(); ++m) {
        const Points3 values = track.values(animation.meshes[m], k);
        image.texels.middleRows(layout.texel(animation.first[m], k), values.rows()) = values.cast<float>();
      }
  });
  return image;
}

Json write_track(const std::string& path, const Animation& animation, Track track, bool png) {
  DeepImage image = picture_of(animation, track);
  if (!png) {
    track.min.setZero();
    track.max.setOnes();
  } else {
    const Eigen::RowVector3f low = track.min.cast<float>(), span = (track.max - track.min).cast<float>();
    image.texels = ((image.texels.rowwise() - low).array().rowwise() / span.array()).matrix().eval();
  }
  const std::string file = part_path(path, fmt::format(".{}.{}", track.name, png ? "png" : "exr"));
  write_file(file, png ? encode_png16(image) : encode_exr(image));
  return {{"file", file_name(file)},
          {"holds", track.holds},
          {"encoding", png ? "16 bits" : "half float"},
          {"min", triple(track.min)},
          {"max", triple(track.max)}};
}

// The mesh at rest as the GLB holds it, in float32: the shader adds to that.
Points3 rest_of(const Moving& mesh) {
  return mesh.shape(0).positions.cast<float>().cast<double>();
}

Points3 offsets(const Moving& mesh, int frame) {
  return mesh.shape(frame).positions - rest_of(mesh);
}

Points3 colours(const Moving& mesh, int frame) {
  if (mesh.colour_count == 0) return Points3::Ones(vertices_of(mesh), 3);
  return mesh.colours(std::min(frame, mesh.colour_count - 1));
}

/// The least and the largest of each coordinate over all frames.
std::pair<Row, Row> range_of(const Animation& animation, Points3 (*values)(const Moving&, int)) {
  const int frames = animation.layout.frames;
  Points3 low(frames, 3), high(frames, 3);
  parallel_for(frames, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      for (std::size_t m = 0; m < animation.meshes.size(); ++m) {
        const Points3 rows = values(animation.meshes[m], k);
        const Row least = rows.colwise().minCoeff(), most = rows.colwise().maxCoeff();
        low.row(k) = m == 0 ? least : least.cwiseMin(low.row(k));
        high.row(k) = m == 0 ? most : most.cwiseMax(high.row(k));
      }
  });
  return {low.colwise().minCoeff(), high.colwise().maxCoeff()};
}

std::vector<Track> tracks(const Animation& animation) {
  auto [low, high] = range_of(animation, offsets);
  for (int c = 0; c < 3; ++c)
    if (!(high[c] > low[c])) high[c] = low[c] + 1.0;  // nothing moves along it
  return {{"positions", "offset from the rest mesh", offsets, low, high},
          {"normals", "unit normal", [](const Moving& mesh, int frame) { return mesh.shape(frame).normals; },
           -Row::Ones(), Row::Ones()},
          {"colours", "linear colour, which multiplies the texture of the mesh", colours, Row::Zero(),
           Row::Ones()}};
}

/// The mesh with some of its faces and the vertices that they have.
Moving with_faces(const Moving& mesh, const Faces& faces) {
  std::vector<int> kept(faces.data(), faces.data() + faces.size());
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  Moving part = mesh;
  part.faces = faces.unaryExpr([&kept](int vertex) {
    return static_cast<int>(std::lower_bound(kept.begin(), kept.end(), vertex) - kept.begin());
  });
  if (mesh.uv.rows() > 0) part.uv = mesh.uv(kept, Eigen::all);
  part.lookup = mesh.lookup(kept, Eigen::all);
  if (mesh.water.size() > 0) part.water = mesh.water(kept);
  part.shape = [shape = mesh.shape, kept](int frame) {
    const Shape whole = shape(frame);
    return Shape{whole.positions(kept, Eigen::all), whole.normals(kept, Eigen::all)};
  };
  part.colours = [of_all = mesh.colours, kept](int frame) -> Points3 {
    return of_all(frame)(kept, Eigen::all);
  };
  return part;
}

// Level 0 is the full mesh. Each of them is the rest mesh with the colours of the first frame.
std::vector<WrittenLevel> write_levels(const std::string& path, const Clip& clip, const Animation& animation,
                                       int count) {
  GlbScene scene;
  scene.frames.kept = {0};
  scene.iterations = {clip.frames.front().iteration};
  scene.times = {0.0};
  scene.texture = clip.texture;
  scene.normal_texture = clip.normal_texture;
  scene.extras = glb_extras(clip, scene.frames);
  std::vector<std::vector<DetailLevel>> coarser;
  for (const Moving& mesh : animation.meshes)
    coarser.push_back(levels_of_detail(mesh, animation.layout.frames, count));
  std::vector<WrittenLevel> written(static_cast<std::size_t>(count) + 1);
  for (std::size_t level = 0; level < written.size(); ++level) {
    scene.meshes.clear();
    for (std::size_t m = 0; m < animation.meshes.size(); ++m) {
      Moving mesh = animation.meshes[m];
      if (level > 0) {
        const DetailLevel& made = coarser[m][level - 1];
        mesh = with_faces(mesh, made.faces);
        written[level].deviation =
            std::max(written[level].deviation, made.deviation * metres_per_unit(clip.leaf.placement));
      }
      mesh.colour_count = std::min(mesh.colour_count, 1);
      written[level].triangles += static_cast<int>(mesh.faces.rows());
      scene.meshes.push_back(std::move(mesh));
    }
    write_file(level_path(path, static_cast<int>(level)), glb_bytes(scene));
  }
  return written;
}

Json levels_json(const std::string& path, const std::vector<WrittenLevel>& levels) {
  Json list = Json::array();
  for (std::size_t level = 0; level < levels.size(); ++level)
    list.push_back({{"file", file_name(level_path(path, static_cast<int>(level)))},
                    {"triangles", levels[level].triangles},
                    {"deviation_m", levels[level].deviation}});
  return list;
}

Json meshes_json(const Animation& animation) {
  Json list = Json::array();
  for (std::size_t m = 0; m < animation.meshes.size(); ++m)
    list.push_back({{"name", animation.meshes[m].name},
                    {"first_vertex", animation.first[m]},
                    {"vertices", vertices_of(animation.meshes[m])}});
  return list;
}

}  // namespace

void AnimationTextureOptions::validate() const {
  clip.validate();
  if (levels < 0 || levels > kMostLevels)
    throw Error(ErrorCode::configuration,
                fmt::format("{} levels of detail are asked for; 0 to {} can be made", levels, kMostLevels));
}

std::vector<std::string> animation_texture_files(const std::string& path) {
  std::vector<std::string> files{path};
  for (int level = 0; level <= kMostLevels; ++level) files.push_back(level_path(path, level));
  for (const char* name : {"positions", "normals", "colours"})
    for (const char* kind : {"exr", "png"})
      files.push_back(part_path(path, fmt::format(".{}.{}", name, kind)));
  return files;
}

std::vector<WrittenLevel> write_animation_texture(const std::string& path, const Clip& clip,
                                                  const AnimationTextureOptions& options) {
  options.validate();
  const int frames = static_cast<int>(clip.frames.size());
  GlbOptions shape;
  shape.stalk_sides = options.clip.stalk_sides;
  const Animation animation(glb_scene(clip, shape).meshes, frames);
  const auto [low, high] = range_of(
      animation, +[](const Moving& mesh, int k) -> Points3 { return mesh.shape(k).positions; });
  const TexelLayout& layout = animation.layout;
  Json json = {{"wilt", version()},
               {"frames", frames},
               {"seconds", options.clip.seconds},
               {"fps", (frames - 1) / options.clip.seconds},
               {"times_s", key_times(clip.frames, options.clip.seconds)},
               {"vertices", layout.vertices},
               {"texture",
                {{"width", layout.width},
                 {"height", layout.height},
                 {"rows_per_frame", layout.rows_per_frame},
                 {"first_row", "top"}}},
               {"up", "Y"},
               {"handedness", "right"},
               {"metres_per_unit", metres_per_unit(clip.leaf.placement)},
               {"bounds", {{"min", triple(low)}, {"max", triple(high)}}},
               {"meshes", meshes_json(animation)}};
  for (const Track& track : tracks(animation))
    json[track.name] = write_track(path, animation, track, options.png);
  const std::vector<WrittenLevel> levels = write_levels(path, clip, animation, options.levels);
  json["levels"] = levels_json(path, levels);
  write_file(path, json.dump(2) + "\n");
  return levels;
}

}  // namespace wilt
