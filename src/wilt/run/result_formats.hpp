// What a result can be written as: one table, which the help, the checks and the writing share.
#pragma once

#include <string>
#include <vector>

namespace wilt {

class ResultFiles;

/// A file that a format writes.
struct ResultFile {
  std::string path;
  bool common = false;  ///< the same bytes whichever format writes it: textures
};

struct ResultFormat {
  std::vector<std::string>
      extensions;       ///< with their dots, in lower case; the first one is named in messages
  const char* content;  ///< "all frames as morph targets": ends the sentence "a .glb holds"
  /// Every file that stands for `path` after a run of `frames` frames.
  std::vector<ResultFile> (*files)(const std::string& path, int frames);
  void (*write)(ResultFiles& result, const std::string& path);
};

const std::vector<ResultFormat>& result_formats();

/// By the longest extension that ends `path`. Throws Error{configuration} with the table for any other.
const ResultFormat& result_format(const std::string& path);

/// A line for each format: what -o's help says.
std::string result_formats_help();

/// Every file that the results of a run of `frames` frames are.
std::vector<std::string> result_files(const std::vector<std::string>& paths, int frames);

/// Throws unless every path has an extension of the table and can become a file, and no file is
/// to be written twice with different contents: said before the work. `others`: further files of the run.
void check_results(const std::vector<std::string>& paths, const std::vector<std::string>& others, int frames);

}  // namespace wilt
