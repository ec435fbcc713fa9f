#include "wilt/output/point_cache.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/byte_order.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {
namespace {

// The positions at a time between the first and the last: linear between frames.
Points3 positions_at(const PointTrack& track, double time) {
  constexpr double kSame = 1e-9;  // of a second
  int next = 0;
  while (track.times[static_cast<std::size_t>(next)] < time - kSame) ++next;
  const double after = track.times[static_cast<std::size_t>(next)];
  if (after <= time + kSame) return track.positions(next);
  const double before = track.times[static_cast<std::size_t>(next) - 1];
  const double share = (time - before) / (after - before);
  return (1.0 - share) * track.positions(next - 1) + share * track.positions(next);
}

}  // namespace

PointTrack blade_track(const Clip& clip, const ClipOptions& options) {
  return {key_times(clip.frames, options.seconds), clip.leaf.mesh.num_vertices(),
          [&clip](int frame) { return blade_shape(clip, frame).positions; }};
}

PointTrack stalk_track(const Clip& clip, const ClipOptions& options) {
  if (clip.frames.front().stalk.rows() < 2) return {};
  const Moving stalk = moving_stalk(clip, options.stalk_sides);
  return {key_times(clip.frames, options.seconds), static_cast<int>(stalk.shape(0).positions.rows()),
          [stalk](int frame) { return stalk.shape(frame).positions; }};
}

std::string pc2_bytes(const PointTrack& track, double frame_rate) {
  const int samples = static_cast<int>(track.times.size());
  const double interval = samples > 1 ? track.times.back() / (samples - 1) : 1.0 / frame_rate;
  std::string bytes = "POINTCACHE2";
  bytes += '\0';
  for (const std::int32_t number : {1, track.points}) append_little_endian(bytes, number);
  append_little_endian(bytes, 0.0F);
  append_little_endian(bytes, static_cast<float>(interval * frame_rate));
  append_little_endian(bytes, static_cast<std::int32_t>(samples));
  for (int k = 0; k < samples; ++k) {
    const Points3 positions = positions_at(track, k * interval);
    for (const double coordinate : positions.reshaped<Eigen::RowMajor>())
      append_little_endian(bytes, static_cast<float>(coordinate));
  }
  return bytes;
}

std::string mdd_bytes(const PointTrack& track) {
  std::string bytes;
  append_big_endian(bytes, static_cast<std::int32_t>(track.times.size()));
  append_big_endian(bytes, static_cast<std::int32_t>(track.points));
  for (const double time : track.times) append_big_endian(bytes, static_cast<float>(time));
  for (int k = 0; k < static_cast<int>(track.times.size()); ++k) {
    const Points3 positions = track.positions(k);
    for (const double coordinate : positions.reshaped<Eigen::RowMajor>())
      append_big_endian(bytes, static_cast<float>(coordinate));
  }
  return bytes;
}

PointCacheHead parse_point_cache(std::string_view bytes, const std::string& path) {
  const bool is_mdd = extension_of(path) == ".mdd";
  const std::size_t head = is_mdd ? 8 : 32;
  PointCacheHead result;
  bool fits = bytes.size() >= head && (is_mdd || bytes.substr(0, 11) == "POINTCACHE2");
  std::size_t times = 0;
  if (fits) {
    result.frames = number_at<std::int32_t>(bytes, is_mdd ? 0 : 28, is_mdd);
    result.points = number_at<std::int32_t>(bytes, is_mdd ? 4 : 16, is_mdd);
    fits = result.frames >= 1 && result.points >= 1;
    times = is_mdd && fits ? 4 * static_cast<std::size_t>(result.frames) : 0;
  }
  const std::size_t frame = 12 * static_cast<std::size_t>(result.points);
  if (!fits || (bytes.size() - head) / static_cast<std::size_t>(result.frames) != frame + (is_mdd ? 4 : 0))
    throw Error(
        ErrorCode::input,
        fmt::format("'{}' is no {} or is cut short; give a file that wilt or another program wrote whole",
                    path, is_mdd ? "MDD" : "PC2"));
  result.length = is_mdd ? number_at<float>(bytes, head + times - 4, true)
                         : (result.frames - 1) * number_at<float>(bytes, 24, false);
  if (!(result.length >= 0.0 && std::isfinite(result.length)))
    throw Error(
        ErrorCode::input,
        fmt::format("'{}' lasts {}, which no clip does; give a file that wilt or another program wrote whole",
                    path, result.length));
  return result;
}

void write_point_caches(const std::string& path, const Clip& clip, const ClipOptions& options) {
  options.validate();
  const std::string extension = extension_of(path);
  const auto write = [&](const std::string& file, const PointTrack& track) {
    write_file(file, extension == ".mdd" ? mdd_bytes(track) : pc2_bytes(track, options.frame_rate));
  };
  const PointTrack stalk = stalk_track(clip, options);
  write(path, blade_track(clip, options));
  if (!stalk.times.empty()) write(beside(path, ".stalk" + extension), stalk);
}

}  // namespace wilt
