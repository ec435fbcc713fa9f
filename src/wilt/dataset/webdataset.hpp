// WebDataset: the samples of a data set in tar files of a handy size, for readers that stream.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace wilt {

/// A file of a sample: KEY.SUFFIX in the tar.
struct SampleFile {
  std::string suffix;  ///< "png", "leaf.png", "json"
  std::string bytes;
};

struct ShardOptions {
  int samples = 1000;                            ///< in a shard at most, >= 1
  std::uint64_t bytes = std::uint64_t{1} << 30;  ///< after which a shard takes no more samples, >= 1
  void validate() const;                         ///< throws Error{configuration}
};

/// Writes shard-000000.tar, shard-000001.tar, ... into a folder (github.com/webdataset/webdataset: the files
/// of a sample stand one after the other and share what is before the first dot of their names).
///
/// Plain ustar, every file with mode 0644, no owner and no time: the same samples give the same bytes.
/// Memory: the sample that is added.
class WebDatasetWriter {
 public:
  /// The folder must exist. Throws Error{configuration} for options out of range.
  explicit WebDatasetWriter(std::string folder, const ShardOptions& options = {});
  ~WebDatasetWriter();

  /// `key` has neither dot nor slash, is not empty and differs from all others; so do the suffixes of `files`
  /// (>= 1) among each other. Throws Error{output}, std::logic_error for a wrong key or none of files.
  void add(const std::string& key, const std::vector<SampleFile>& files);

  /// The last shard appears; shards with higher numbers, left by an earlier and longer run, are removed.
  /// Returns the names of all. Each is whole or not there at all. Throws Error{output}.
  std::vector<std::string> finish();

 private:
  class Shard;
  std::string path(std::size_t number) const;

  std::string folder_;
  ShardOptions options_;
  std::unique_ptr<Shard> shard_;
  std::vector<std::string> names_;
};

}  // namespace wilt
