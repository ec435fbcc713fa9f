#include "wilt/core/file_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <random>
#include <utility>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string remedy(const std::string& path, int reason) {
  const std::string folder = folder_of(path);
  switch (reason) {
    case ENOENT:
      return fmt::format("the folder '{0}' does not exist; make it (mkdir -p '{0}') or choose another path",
                         folder);
    case ENOTDIR:
      return fmt::format("a part of '{}' is a file, not a folder; choose another path", folder);
    case EISDIR:
      return "it is a folder; give the name of a file in it";
    case EACCES:
    case EPERM:
      return "allow writing there (chmod u+w) or choose another path";
    case EROFS:
      return "the file system is read-only; choose another path";
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another disk";
    case EFBIG:
      return "the limit on the size of files is too small (ulimit -f); raise it or write fewer frames";
    case EPIPE:
      return "the program that reads the pipe has ended";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "choose another path";
  }
}

[[noreturn]] void fail(const std::string& path, int reason) {
  throw Error(ErrorCode::output,
              fmt::format("cannot write '{}': {}: {}", path, std::strerror(reason), remedy(path, reason)));
}

// The descriptor that /dev/stdout, /dev/stderr or /dev/fd/N stands for.
std::optional<int> standing_descriptor(std::string_view path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  constexpr std::string_view kPrefix = "/dev/fd/";
  if (path.substr(0, kPrefix.size()) != kPrefix) return std::nullopt;
  path.remove_prefix(kPrefix.size());
  int descriptor = -1;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), descriptor);
  if (error != std::errc() || end != path.data() + path.size()) return std::nullopt;
  return descriptor;
}

// A name that cannot be guessed.
std::string temporary_name(const std::string& folder) {
  std::random_device device;
  return fmt::format("{}/.wilt-{:08x}{:08x}.tmp", folder, device(), device());
}

// A file without a name in the folder: should the program be killed, nothing is left. -1 where the system or
// its file system has no such files.
int open_unnamed([[maybe_unused]] const std::string& folder) {
#ifdef O_TMPFILE
  return ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
#else
  return -1;
#endif
}

// Gives an unnamed file a name that nobody has; whether it could.
bool give_name(int descriptor, const std::string& name) {
  const std::string file = fmt::format("/proc/self/fd/{}", descriptor);
  return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

// O_EXCL: nobody can have put a link there. The mode lets the umask act; a file that has a mode gets it
// later.
int open_named(const std::string& name, bool has_mode) {
  return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, has_mode ? 0600 : 0666);
}

// 0, or the reason why not.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

int copy_all(int from, int to) {
  std::string block(std::size_t{1} << 16, '\0');
  for (off_t place = 0;;) {
    const ssize_t count = ::pread(from, block.data(), block.size(), place);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return 0;
    place += count;
    const std::string_view bytes(block.data(), static_cast<std::size_t>(count));
    if (const int reason = write_all(to, bytes)) return reason;
  }
}

}  // namespace

FileWriter::FileWriter(const std::string& path) : path_(path) {
  open();
}

void FileWriter::open() {
  if (const auto descriptor = standing_descriptor(path_)) return begin_in_place(::dup(*descriptor));
  struct stat status;
  if (::stat(path_.c_str(), &status) != 0) {
    if (errno != ENOENT) fail(path_, errno);
    return begin_temporary(path_);
  }
  // Opening it says whether we may write there at all: rename would not ask.
  const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path_, errno);
  if (!S_ISREG(status.st_mode)) return begin_in_place(descriptor);
  ::close(descriptor);
  mode_ = static_cast<int>(status.st_mode & 07777);
  begin_temporary(std::filesystem::canonical(path_).string());
}

FileWriter::~FileWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileWriter::begin_in_place(int descriptor) {
  if (descriptor < 0) fail(path_, errno);
  descriptor_ = descriptor;
}

void FileWriter::begin_temporary(const std::string& target) {
  target_ = target;
  descriptor_ = open_unnamed(folder_of(target));
  if (descriptor_ < 0) name_temporary();
}

// Under a name, for systems without files that have none.
void FileWriter::name_temporary() {
  const std::string name = temporary_name(folder_of(target_));
  const int named = open_named(name, mode_ >= 0);
  if (named < 0) fail(path_, errno);
  temporary_ = name;
  const int unnamed = std::exchange(descriptor_, named);
  if (unnamed < 0) return;
  const int reason = copy_all(unnamed, named);
  ::close(unnamed);
  if (reason != 0) fail(path_, reason);
}

void FileWriter::write(std::string_view bytes) {
  if (const int reason = write_all(descriptor_, bytes)) fail(path_, reason);
}

void FileWriter::flush() {
  if (mode_ >= 0 && ::fchmod(descriptor_, static_cast<mode_t>(mode_)) != 0) fail(path_, errno);
  if (::fsync(descriptor_) != 0) fail(path_, errno);
}

void FileWriter::finish() {
  if (!target_.empty()) {
    flush();
    if (temporary_.empty()) take_name();
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, errno);
  if (target_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, errno);
  temporary_.clear();
}

void FileWriter::take_name() {
  const std::string name = temporary_name(folder_of(target_));
  if (give_name(descriptor_, name)) {
    temporary_ = name;
  } else {
    name_temporary();
    flush();
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  FileWriter writer(path);
  writer.write(bytes);
  writer.finish();
}

void check_writable(const std::string& path) {
  const std::string folder = folder_of(path);
  if (std::filesystem::is_directory(path)) fail(path, EISDIR);
  if (!std::filesystem::is_directory(folder)) fail(path, std::filesystem::exists(folder) ? ENOTDIR : ENOENT);
  const bool is_new = !std::filesystem::exists(path);
  if (::access(is_new ? folder.c_str() : path.c_str(), is_new ? W_OK | X_OK : W_OK) != 0) fail(path, errno);
}

}  // namespace wilt
