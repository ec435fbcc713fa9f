#include "wilt/core/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <random>
#include <utility>

#include "wilt/core/error.hpp"

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

/// An open file that is closed again, and removed if it was never kept.
class Output {
 public:
  Output(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (temporary_) ::unlink(path_.c_str());
  }

  bool open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  const std::string& path() const { return path_; }
  void mark_temporary() { temporary_ = true; }
  void kept() { temporary_ = false; }

  /// 0, or the reason why not.
  int write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }
  int close() { return ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno; }

 private:
  std::string path_;
  int descriptor_;
  bool temporary_ = false;
};

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

void write_in_place(const std::string& path, int descriptor, std::string_view bytes) {
  if (descriptor < 0) fail(path, errno);
  Output output(path, descriptor);
  if (const int reason = output.write(bytes)) fail(path, reason);
  if (const int reason = output.close()) fail(path, reason);
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
  return ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
#else
  return -1;
#endif
}

// Gives an unnamed file a name that nobody has; whether it could.
bool give_name(int descriptor, const std::string& name) {
  const std::string file = fmt::format("/proc/self/fd/{}", descriptor);
  return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

// Everything but the name.
void fill(const Output& output, const std::string& path, std::optional<mode_t> mode, std::string_view bytes) {
  if (mode && ::fchmod(output.descriptor(), *mode) != 0) fail(path, errno);
  if (const int reason = output.write(bytes)) fail(path, reason);
  if (::fsync(output.descriptor()) != 0) fail(path, errno);
}

void take_place(Output& output, const std::string& path, const std::string& target) {
  if (const int reason = output.close()) fail(path, reason);
  if (::rename(output.path().c_str(), target.c_str()) != 0) fail(path, errno);
  output.kept();
}

void replace_file(const std::string& path, const std::string& target, std::optional<mode_t> mode,
                  std::string_view bytes) {
  const std::string name = temporary_name(folder_of(target));
  if (const int descriptor = open_unnamed(folder_of(target)); descriptor >= 0) {
    Output output(name, descriptor);
    fill(output, path, mode, bytes);
    if (give_name(descriptor, name)) {
      output.mark_temporary();
      return take_place(output, path, target);
    }
  }
  // O_EXCL: nobody can have put a link there. The mode lets the umask act.
  Output output(name, ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!output.open()) fail(path, errno);
  output.mark_temporary();
  fill(output, path, mode, bytes);
  take_place(output, path, target);
}

}  // namespace

void write_file(const std::string& path, std::string_view bytes) {
  if (const auto descriptor = standing_descriptor(path))
    return write_in_place(path, ::dup(*descriptor), bytes);
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) fail(path, errno);
    return replace_file(path, path, std::nullopt, bytes);
  }
  // Opening it says whether we may write there at all: rename would not ask.
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (!S_ISREG(status.st_mode)) return write_in_place(path, descriptor, bytes);
  if (descriptor < 0) fail(path, errno);
  ::close(descriptor);
  replace_file(path, std::filesystem::canonical(path).string(), status.st_mode & 07777, bytes);
}

void check_writable(const std::string& path) {
  const std::string folder = folder_of(path);
  if (std::filesystem::is_directory(path)) fail(path, EISDIR);
  if (!std::filesystem::is_directory(folder)) fail(path, std::filesystem::exists(folder) ? ENOTDIR : ENOENT);
  const bool is_new = !std::filesystem::exists(path);
  if (::access(is_new ? folder.c_str() : path.c_str(), is_new ? W_OK | X_OK : W_OK) != 0) fail(path, errno);
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::string read_file(const std::string& path, std::uint64_t most) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::input, fmt::format("cannot read '{}': {}", path, reason));
  };
  const auto fail_reading = [&](int reason) {
    refuse(fmt::format("{}: check the path and its permissions", std::strerror(reason)));
  };
  if (descriptor < 0) fail_reading(errno);
  const Output input(path, descriptor);
  std::string bytes;
  struct stat status;
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode))
    bytes.reserve(std::min<std::uint64_t>(most, static_cast<std::uint64_t>(status.st_size)));
  std::string block(std::size_t{1} << 16, '\0');
  try {
    while (true) {
      const ssize_t count = ::read(descriptor, block.data(), block.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail_reading(errno);
      if (count == 0) return bytes;
      bytes.append(block, 0, static_cast<std::size_t>(count));
      if (bytes.size() > most) refuse(fmt::format("it is larger than {} bytes, the most that is read", most));
    }
  } catch (const std::bad_alloc&) {
    refuse(fmt::format("there is no memory for more than {} bytes of it", bytes.size()));
  }
  return bytes;
}

}  // namespace wilt
