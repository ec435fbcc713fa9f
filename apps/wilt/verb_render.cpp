// wilt render: pictures, contact sheets and films of a result.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "arguments.hpp"
#include "checks.hpp"
#include "plan.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/stack_rows.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/render/contact_sheet.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/render/movie.hpp"
#include "wilt/render/picture.hpp"

namespace wilt::cli {
namespace {

constexpr int kSheetFrames = 12, kFps = 25, kSamples = 64;

struct Request {
  std::string file, output, size, view, sun;
  std::optional<int> frame, samples, columns, frames, fps;
  int threads = 0;
  std::uint64_t seed = 1;
  bool dry_run = false;
};

enum class Kind { picture, sheet, movie };
constexpr const char* kKinds[] = {"picture", "sheet", "film"};
constexpr const char* kMade[] = {"a picture", "a contact sheet", "a film"};

Kind kind_of(const Request& request) {
  if (MovieWriter::is_movie(request.output)) return Kind::movie;
  const std::filesystem::path path(request.output);
  if (!is_picture_path(request.output))
    throw Error(
        ErrorCode::configuration,
        fmt::format("cannot write '{}': a picture or sheet is .png or .jpg, a film .mp4, .webm or .gif",
                    request.output));
  const std::string stem = path.stem().string();
  const bool named = stem.size() >= 5 && stem.compare(stem.size() - 5, 5, "sheet") == 0;
  return named || request.columns || request.frames ? Kind::sheet : Kind::picture;
}

void set_size(PictureOptions& picture, const Request& request, Kind kind) {
  static constexpr int kWidth[] = {960, 480, 640}, kHeight[] = {720, 360, 480};
  picture.width = kWidth[int(kind)], picture.height = kHeight[int(kind)];
  if (request.size.empty()) return;
  const PixelSize size = parse_size(request.size, "--size takes two numbers like 1920x1080");
  for (const int side : {size.width, size.height})
    if (side < 16 || side > 16384)
      throw Error(ErrorCode::configuration,
                  fmt::format("--size is {}; width and height are 16 to 16384 pixels", request.size));
  picture.width = size.width, picture.height = size.height;
}

// An option that means nothing for what is made is a mistake of the caller.
void check_options(const Request& request, Kind kind) {
  const auto refuse_unless = [&](bool fits, bool given, const char* option) {
    if (given && !fits)
      throw Error(ErrorCode::configuration,
                  fmt::format("{} does not go with {} ('{}')", option, kMade[int(kind)], request.output));
  };
  refuse_unless(kind == Kind::picture, request.frame.has_value(), "--frame");
  refuse_unless(kind == Kind::sheet, request.columns.has_value(), "--columns");
  refuse_unless(kind == Kind::sheet, request.frames.has_value(), "--frames");
  refuse_unless(kind == Kind::movie, request.fps.has_value(), "--fps");
}

PictureOptions picture_options(const Request& request, Kind kind) {
  PictureOptions picture;
  set_size(picture, request, kind);
  picture.samples = request.samples.value_or(kSamples);
  picture.seed = request.seed;
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (!request.view.empty()) {
    const Vec2 view = parse_pair(request.view, ',', "--view takes two numbers like -75,45");
    if (std::abs(view.y()) > 90.0)
      throw Error(ErrorCode::configuration,
                  fmt::format("--view is {}; the second angle is -90 to 90 degrees", request.view));
    picture.view.azimuth = view.x() * kDegree;
    picture.view.elevation = view.y() * kDegree;
  }
  if (!request.sun.empty()) {
    const Vec2 sun = parse_pair(request.sun, ',', "--sun takes two numbers like 140,35") * kDegree;
    picture.lighting.sun.direction = sun_direction(sun.x(), sun.y());
  }
  return picture;
}

// One camera for all: closest that sees every frame.
Camera camera_for(const LeafScene& leaf, const std::vector<double>& frames, const PictureOptions& picture) {
  std::vector<Points3> parts;
  for (const double frame : frames) parts.push_back(scene_points(leaf.at(frame)));
  return frame_camera(stack_rows(parts), double(picture.width) / picture.height, picture.view);
}

std::vector<double> evenly(int count, double last) {
  std::vector<double> frames;
  for (int i = 0; i < count; ++i) frames.push_back(count == 1 ? last : last * i / (count - 1));
  return frames;
}

// Progress over several pictures as one.
Monitor part_of(const Monitor& whole, int index, int count) {
  Monitor part = whole;
  if (whole.progress)
    part.progress = [whole, index, count](std::string_view stage, double fraction) {
      whole.progress(stage, (index + fraction) / count);
    };
  return part;
}

Image sheet(const LeafScene& leaf, PictureOptions picture, const Request& request, const Monitor& monitor) {
  const int count = std::min(request.frames.value_or(kSheetFrames), leaf.frames());
  std::vector<double> frames = evenly(count, leaf.frames() - 1);
  for (double& frame : frames) frame = std::round(frame);
  picture.camera = camera_for(leaf, frames, picture);
  std::vector<Image> images;
  for (int i = 0; i < count; ++i)
    images.push_back(render(leaf.at(frames[std::size_t(i)]), picture, part_of(monitor, i, count)));
  return contact_sheet(images, request.columns.value_or(4));
}

// The frame that is shown at a time of the clip.
double frame_at(const GlbFile& file, double time) {
  std::size_t next = 1;
  while (next + 1 < file.times.size() && file.times[next] < time) ++next;
  const double a = file.times[next - 1], b = file.times[next];
  return double(next - 1) + std::clamp((time - a) / (b - a), 0.0, 1.0);
}

void movie(const GlbFile& file, const LeafScene& leaf, PictureOptions picture, const Request& request,
           const Monitor& monitor) {
  const int fps = request.fps.value_or(kFps);
  MovieWriter writer(request.output, picture.width, picture.height, fps);
  picture.camera = camera_for(leaf, evenly(leaf.frames(), leaf.frames() - 1), picture);
  const int count = 1 + static_cast<int>(std::lround(file.times.back() * fps));
  for (int i = 0; i < count; ++i)
    writer.add(render(leaf.at(frame_at(file, double(i) / fps)), picture, part_of(monitor, i, count)));
  writer.finish();
}

// Throws unless the file has the frames that are asked for.
void check_frames(const Request& request, Kind kind, int frames) {
  if (kind == Kind::movie && frames < 2)
    throw Error(ErrorCode::input,
                fmt::format("'{}' does not move; a film needs two frames or more", request.file));
  if (const int frame = request.frame.value_or(0); frame >= frames)
    throw Error(ErrorCode::configuration,
                fmt::format("--frame is {}; '{}' has the frames 0 to {}", frame, request.file, frames - 1));
}

void plan(const Request& request, Kind kind, const PictureOptions& picture, int frames,
          const GlobalOptions& options) {
  if (kind == Kind::movie)
    const MovieWriter can_be_made(request.output, picture.width, picture.height, request.fps.value_or(kFps));
  print_plan(fmt::format("make {} of {}: {} frames, {} samples per pixel", kMade[int(kind)], request.file,
                         frames, picture.samples),
             {{"result", request.file},
              {"kind", kKinds[int(kind)]},
              {"frames", frames},
              {"width", picture.width},
              {"height", picture.height},
              {"samples", picture.samples}},
             {request.output}, options);
}

void run(const Request& request, const GlobalOptions& options) {
  const Kind kind = kind_of(request);
  check_options(request, kind);
  const PictureOptions picture = picture_options(request, kind);
  picture.validate();
  check_writable(request.output);
  const ThreadLimit limit(request.threads);
  Terminal terminal(options);
  const GlbFile file = read_glb(request.file);
  const LeafScene leaf(file);
  check_frames(request, kind, leaf.frames());
  if (request.dry_run) return plan(request, kind, picture, leaf.frames(), options);
  if (kind == Kind::movie) {
    movie(file, leaf, picture, request, terminal.monitor());
  } else if (kind == Kind::sheet) {
    write_image(request.output, sheet(leaf, picture, request, terminal.monitor()));
  } else {
    const int frame = request.frame.value_or(leaf.frames() - 1);
    write_image(request.output, render(leaf.at(frame), picture, terminal.monitor()));
  }
  terminal.say("wrote " + request.output);
  if (options.json) {
    const nlohmann::ordered_json json = {{"file", request.output}, {"kind", kKinds[int(kind)]}};
    print_data(json.dump(2) + "\n");
  }
}

}  // namespace

void add_render(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("render",
                         "Pictures, contact sheets and films of a result\n\n"
                         "Examples:\n"
                         "  wilt render maple.glb -o maple.png\n"
                         "  wilt render maple.glb -o poster.png --size 1920x1080 --samples 256 --sun 60,28\n"
                         "  wilt render maple.glb -o sheet.png --columns 6 --frames 12\n"
                         "  wilt render maple.glb -o maple.mp4\n"
                         "  wilt render maple.glb -o top.png --view -90,90 --frame 0\n");
  verb->add_option("FILE", request->file, "A .glb that wilt wrote")->required()->type_name("FILE");
  verb->add_option(
          "-o,--output", request->output,
          "Picture (.png .jpg), contact sheet (its name ends in sheet.png, or --columns\nor --frames is "
          "given), film "
          "(.mp4 .webm .gif)")
      ->required()
      ->type_name("FILE");
  verb->add_option("--frame", request->frame, "Frame of the picture, from 0 (the last)")
      ->check(whole_number(0, 1000000))
      ->type_name("N");
  verb->add_option("--size", request->size,
                   "Of a picture (960x720), of each in a sheet (480x360), of a film (640x480)")
      ->type_name("WxH");
  verb->add_option("--samples", request->samples, "Per pixel at most (64; 256 for a fine still)")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  verb->add_option("--columns", request->columns, "Of a sheet (4)")
      ->check(whole_number(1, 1000))
      ->type_name("N");
  verb->add_option("--frames", request->frames, "Pictures in a sheet (12, or all when fewer)")
      ->check(whole_number(1, 100000))
      ->type_name("N");
  verb->add_option("--fps", request->fps, "Pictures a second of a film (25)")
      ->check(whole_number(1, 120))
      ->type_name("N");
  verb->add_option("--view", request->view,
                   "Camera, degrees: around (-90 looks to the apex) and above (-75,45)")
      ->type_name("A,E");
  verb->add_option("--sun", request->sun, "Sun, degrees: around and above (146,38)")->type_name("A,E");
  verb->add_option("--seed", request->seed, "Of the samples (1)")
      ->check(whole_number(0, kMostSeed))
      ->type_name("N");
  verb->add_option("--threads", request->threads, "At most so many (all)")
      ->check(whole_number(1, 1024))
      ->type_name("N");
  add_dry_run(*verb, request->dry_run);
  verb->callback([request, &options] { run(*request, options); });
}

}  // namespace wilt::cli
