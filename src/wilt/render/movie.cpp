#include "wilt/render/movie.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <boost/process.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <map>
#include <vector>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

namespace process = boost::process;

// What ffmpeg is told to make of each kind of film.
const std::map<std::string, std::vector<std::string>>& codecs() {
  static const std::map<std::string, std::vector<std::string>> kCodecs = {
      {".mp4",
       {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2",
        "-movflags", "+faststart"}},
      {".webm",
       {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-pix_fmt", "yuv420p", "-vf",
        "crop=trunc(iw/2)*2:trunc(ih/2)*2"}},
      {".gif", {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}},
  };
  return kCodecs;
}

/// A file in memory: it needs no disk, nobody else can find it, and it is gone when the program is, however
/// that ends. ffmpeg inherits its descriptor.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("wilt", 0)) {
    if (descriptor_ < 0)
      throw Error(ErrorCode::output,
                  fmt::format("a film cannot be begun: {}; close some programs", std::strerror(errno)));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// A path under which this program and its children reach it.
  std::string path() const { return fmt::format("/dev/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

class MovieWriter::Encoder {
 public:
  Encoder(const std::string& path, int width, int height, int fps)
      : path_(path), width_(width), height_(height) {
    const auto program = process::search_path("ffmpeg");
    if (program.empty())
      throw Error(ErrorCode::output,
                  "a film needs the program ffmpeg, which is not there; install it (Debian: apt-get install "
                  "ffmpeg), or write a sheet.png");
    std::vector<std::string> arguments = {"-v",       "error",
                                          "-f",       "rawvideo",
                                          "-pix_fmt", "rgb24",
                                          "-s",       fmt::format("{}x{}", width, height),
                                          "-r",       std::to_string(fps),
                                          "-i",       "-"};
    const auto& codec = codecs().at(extension_of(path));
    arguments.insert(arguments.end(), codec.begin(), codec.end());
    arguments.insert(arguments.end(), {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "2",
                                       "-xerror", "-f", extension_of(path).substr(1), "-y", film_.path()});
    std::error_code failed;
    child_ = process::child(
        program, process::args(arguments),
        process::std_in<pictures_, process::std_err> boost::filesystem::path(errors_.path()), group_, failed);
    if (failed) throw Error(ErrorCode::output, fmt::format("ffmpeg cannot be started: {}", failed.message()));
    previous_ = std::signal(SIGPIPE, SIG_IGN);  // a program that stopped is told by the stream
  }

  ~Encoder() {
    pictures_.pipe().close();
    std::error_code ignored;
    if (child_.running(ignored)) child_.terminate(ignored);
    child_.wait(ignored);
    std::signal(SIGPIPE, previous_);
  }

  void add(const Image& picture) {
    WILT_CHECK(picture.width == width_ && picture.height == height_, picture.width, picture.height, width_,
               height_);
    if (!pictures_.write(reinterpret_cast<const char*>(picture.rgb.data()),
                         std::streamsize(picture.rgb.size())))
      fail();
  }

  void finish() {
    pictures_.flush();
    pictures_.pipe().close();
    child_.wait();
    // It may say that it could not write the end, and exit with 0.
    if (child_.exit_code() != 0 || !said().empty()) fail();
    write_file(path_, read_file(film_.path()));
  }

 private:
  std::string said() const { return read_file(errors_.path()); }

  [[noreturn]] void fail() {
    pictures_.pipe().close();
    child_.wait();
    const std::string all = said(), reason = all.substr(0, all.find('\n'));
    throw Error(ErrorCode::output,
                fmt::format("cannot write '{}': ffmpeg could not make the film{}{}; free some memory, or see "
                            "whether `ffmpeg -codecs` has H.264 (.mp4) and VP9 (.webm)",
                            path_, reason.empty() ? "" : ": ", reason));
  }

  std::string path_;
  int width_, height_;
  MemoryFile film_, errors_;
  process::opstream pictures_;
  process::child child_;
  process::group group_;  // out of reach of the terminal's Ctrl-C
  void (*previous_)(int) = SIG_DFL;
};

MovieWriter::MovieWriter(const std::string& path, int width, int height, int fps) {
  if (!is_movie(path))
    throw Error(ErrorCode::configuration, fmt::format("'{}': a film is .mp4, .webm or .gif", path));
  if (fps < 1 || fps > 120)
    throw Error(ErrorCode::configuration, fmt::format("fps is {}; allowed: 1 to 120 pictures a second", fps));
  encoder_ = std::make_unique<Encoder>(path, width, height, fps);
}

MovieWriter::~MovieWriter() = default;

void MovieWriter::add(const Image& picture) {
  encoder_->add(picture);
}

void MovieWriter::finish() {
  encoder_->finish();
}

bool MovieWriter::is_movie(const std::string& path) {
  return codecs().count(extension_of(path)) > 0;
}

}  // namespace wilt
