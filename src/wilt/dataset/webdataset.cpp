#include "wilt/dataset/webdataset.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <utility>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file_writer.hpp"

namespace wilt {
namespace {

constexpr int kBlock = 1 << 16;  // bytes handed to the file at once

std::string shard_name(std::size_t number) {
  return fmt::format("shard-{:06}.tar", number);
}

}  // namespace

void ShardOptions::validate() const {
  if (samples < 1)
    throw Error(ErrorCode::configuration, fmt::format("a shard of {} samples; allowed: 1 or more", samples));
  if (bytes < 1) throw Error(ErrorCode::configuration, "a shard of 0 bytes; allowed: 1 or more");
}

/// A tar that is being written.
class WebDatasetWriter::Shard {
 public:
  explicit Shard(const std::string& path)
      : path_(path),
        file_(path),
        archive_(archive_write_new(), archive_write_free),
        entry_(archive_entry_new(), archive_entry_free) {
    WILT_CHECK(archive_ != nullptr && entry_ != nullptr, path);
    require(archive_write_set_format_ustar(archive_.get()));
    require(archive_write_set_bytes_per_block(archive_.get(), kBlock));
    require(archive_write_set_bytes_in_last_block(archive_.get(), 1));
    require(archive_write_open(archive_.get(), this, nullptr, write, nullptr));
  }

  void add(const std::string& name, const std::string& bytes) {
    archive_entry_clear(entry_.get());
    archive_entry_set_pathname(entry_.get(), name.c_str());
    archive_entry_set_filetype(entry_.get(), AE_IFREG);
    archive_entry_set_perm(entry_.get(), 0644);
    archive_entry_set_mtime(entry_.get(), 0, 0);
    archive_entry_set_size(entry_.get(), static_cast<la_int64_t>(bytes.size()));
    require(archive_write_header(archive_.get(), entry_.get()));
    const la_ssize_t count = archive_write_data(archive_.get(), bytes.data(), bytes.size());
    require(count == static_cast<la_ssize_t>(bytes.size()) ? ARCHIVE_OK : ARCHIVE_FATAL);
    bytes_ += bytes.size();
  }

  void end_sample() { ++samples_; }

  bool full(const ShardOptions& options) const {
    return samples_ >= options.samples || bytes_ >= options.bytes;
  }

  void finish() {
    require(archive_write_close(archive_.get()));
    file_.finish();
  }

 private:
  // Called by the library, which knows no exceptions: they wait until it has returned.
  static la_ssize_t write(archive*, void* shard, const void* data, std::size_t size) {
    auto& self = *static_cast<Shard*>(shard);
    try {
      self.file_.write({static_cast<const char*>(data), size});
      return static_cast<la_ssize_t>(size);
    } catch (...) {
      self.failure_ = std::current_exception();
      return -1;
    }
  }

  void require(int status) {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (status != ARCHIVE_OK)
      throw Error(ErrorCode::output,
                  fmt::format("cannot write '{}': {}", path_, archive_error_string(archive_.get())));
  }

  std::string path_;
  FileWriter file_;
  std::exception_ptr failure_;
  std::unique_ptr<archive, int (*)(archive*)> archive_;
  std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry_;
  std::uint64_t bytes_ = 0;
  int samples_ = 0;
};

WebDatasetWriter::WebDatasetWriter(std::string folder, const ShardOptions& options)
    : folder_(std::move(folder)), options_(options) {
  options_.validate();
}

WebDatasetWriter::~WebDatasetWriter() = default;

std::string WebDatasetWriter::path(std::size_t number) const {
  return (std::filesystem::path(folder_) / shard_name(number)).string();
}

void WebDatasetWriter::add(const std::string& key, const std::vector<SampleFile>& files) {
  WILT_CHECK(!key.empty() && key.find_first_of("./") == std::string::npos && !files.empty(), key,
             files.size());
  if (shard_ && shard_->full(options_)) {
    shard_->finish();
    shard_.reset();
  }
  if (!shard_) {
    shard_ = std::make_unique<Shard>(path(names_.size()));
    names_.push_back(shard_name(names_.size()));
  }
  for (const SampleFile& file : files) shard_->add(key + "." + file.suffix, file.bytes);
  shard_->end_sample();
}

std::vector<std::string> WebDatasetWriter::finish() {
  if (shard_) shard_->finish();
  shard_.reset();
  std::error_code ignored;
  for (std::size_t number = names_.size(); std::filesystem::remove(path(number), ignored); ++number) continue;
  return names_;
}

}  // namespace wilt
