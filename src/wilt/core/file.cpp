#include "wilt/core/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

/// An open file that is closed again.
struct Input {
  int descriptor;
  ~Input() { ::close(descriptor); }
};

}  // namespace

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
  const Input input{descriptor};
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
