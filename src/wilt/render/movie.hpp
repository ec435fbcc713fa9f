// Pictures as a film, encoded by the program ffmpeg.
#pragma once

#include <memory>
#include <string>

#include "wilt/core/image.hpp"

namespace wilt {

/// A film that is being written: .mp4 (H.264), .webm (VP9) or .gif, by its name's end.
///
/// The film appears under its name when it is finished, whole; until then ffmpeg writes into a file in
/// memory, which is gone however the program ends.
class MovieWriter {
 public:
  /// `fps` 1 to 120; widths and heights are cut to even numbers. Throws Error{configuration} for another
  /// extension or rate, Error{output} when ffmpeg cannot be started.
  MovieWriter(const std::string& path, int width, int height, int fps);
  ~MovieWriter();

  void add(const Image& picture);  ///< of the size said; throws Error{output} when ffmpeg stops
  void finish();                   ///< throws Error{output} when ffmpeg fails or the file cannot be written.

  /// Whether `path` ends as a film's does.
  static bool is_movie(const std::string& path);

 private:
  class Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace wilt
