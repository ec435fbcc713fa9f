#include "wilt/output/beside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

/// A path around the row of hashes in its file's name.
struct Hashes {
  std::string before, after;
  int count = 0;

  explicit Hashes(const std::string& path) : before(path) {
    const std::size_t name = path.size() - file_name(path).size();
    const std::size_t first = path.find('#', name);
    if (first == std::string::npos) return;
    const std::size_t end = std::min(path.find_first_not_of('#', first), path.size());
    before = path.substr(0, first);
    after = path.substr(end);
    count = static_cast<int>(end - first);
  }
};

}  // namespace

std::string beside(const std::string& path, std::string_view ending) {
  return std::filesystem::path(path).replace_extension().string() + std::string(ending);
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

bool is_sequence(const std::string& path) {
  return Hashes(path).count > 0;
}

std::string sequence_path(const std::string& pattern, int number) {
  const Hashes hashes(pattern);
  return fmt::format("{}{:0{}}{}", hashes.before, number, hashes.count, hashes.after);
}

void check_sequence(const std::string& pattern) {
  const Hashes hashes(pattern);
  constexpr int kMostDigits = 9;
  if (hashes.count == 0 || hashes.count > kMostDigits || is_sequence(hashes.after))
    throw Error(ErrorCode::configuration,
                fmt::format("'{}' names no sequence: its name has one row of 1 to {} hashes for the number, "
                            "as in 'leaf.####.obj'",
                            pattern, kMostDigits));
}

std::string sequence_stem(const std::string& pattern) {
  const Hashes hashes(pattern);
  std::string before = hashes.before;
  while (!before.empty() && (before.back() == '.' || before.back() == '_' || before.back() == '-'))
    before.pop_back();
  if (before.empty() || before.back() == '/') before += "frames";
  return before + hashes.after;
}

}  // namespace wilt
