#include "wilt/batch/batch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <random>

#include "wilt/batch/item_files.hpp"
#include "wilt/batch/item_fingerprint.hpp"
#include "wilt/batch/manifest.hpp"
#include "wilt/batch/sha256.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const fs::path& path, int reason) {
  throw Error(ErrorCode::output, fmt::format("cannot write '{}': {}; free some space, allow writing there or "
                                             "choose another folder",
                                             path.string(), std::strerror(reason)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, error.value());
}

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// A hidden folder in which an item is made. While it lives it is locked; one that no process has locked was
/// left by a process that was killed.
class Workshop {
 public:
  explicit Workshop(const fs::path& item) {
    while (!begin(item)) {
    }
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  ~Workshop() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  const fs::path& path() const { return path_; }

  /// Whether it got the name; not when another process was faster.
  bool rename_to(const fs::path& item) {
    if (::fsync(descriptor_) != 0) fail(path_, errno);
    if (::rename(path_.c_str(), item.c_str()) != 0) {
      if (errno == ENOTEMPTY || errno == EEXIST) return false;
      fail(item, errno);
    }
    path_.clear();
    return true;
  }

 private:
  // False when another process swept the folder away before it was locked.
  bool begin(const fs::path& item) {
    std::random_device device;
    path_ =
        item.parent_path() / fmt::format(".{}.{}.{:08x}", item.filename().string(), host_name(), device());
    if (::mkdir(path_.c_str(), 0777) != 0) fail(path_, errno);
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0 && errno != ENOENT) fail(path_, errno);
    const bool taken =
        descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (descriptor_ >= 0 && !taken && fs::exists(path_)) return true;
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    return false;
  }

  fs::path path_;
  int descriptor_ = -1;
};

// Removes what killed processes of this machine left: others may not show us their locks.
void sweep(const fs::path& items) {
  const std::string ours = "." + host_name() + ".";
  for (const auto& entry : fs::directory_iterator(items)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != '.' || name.find(ours) == std::string::npos) continue;
    const int descriptor = ::open(entry.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) continue;
    std::error_code ignored;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), ignored);
    ::close(descriptor);
  }
}

// Names of the leaf's files without their folders, which differ from machine to machine.
std::string without_folders(std::string text, const LeafRequest& leaf) {
  for (const std::string& file : {leaf.leaf, leaf.read.mask.string(), leaf.veins}) {
    const std::string name = fs::path(file).filename().string();
    if (name == file) continue;
    for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file, at + name.size()))
      text.replace(at, file.size(), name);
  }
  return text;
}

// The fingerprint that a file of an item says, or nothing when there is no such file.
std::string fingerprint_in(const fs::path& file) {
  if (!fs::exists(file)) return {};
  const Json json = Json::parse(read_file(file.string()), nullptr, false);
  return json.is_object() ? json.value("fingerprint", "unknown") : "unknown";
}

}  // namespace

Batch::Batch(const Plan& plan, fs::path folder)
    : plan_(plan), folder_(std::move(folder)), fingerprints_(std::make_unique<Fingerprints>(plan.outputs())) {
  make_folder(folder_ / "items");
  make_folder(folder_ / "failed");
  sweep(folder_ / "items");
}

Batch::~Batch() = default;

fs::path Batch::item_folder(int item) const {
  return folder_ / "items" / item_name(item);
}

fs::path Batch::failure_file(int item) const {
  return folder_ / "failed" / (item_name(item) + ".json");
}

ItemState Batch::state(int item) {
  return find(item).first;
}

std::pair<ItemState, std::string> Batch::find(int item) {
  const std::string made = fingerprint_in(item_folder(item) / kItemLabels);
  const std::string failed = made.empty() ? fingerprint_in(failure_file(item)) : "";
  if (made.empty() && failed.empty()) return {ItemState::missing, {}};
  const std::string wanted = fingerprints_->of(plan_.item(item));
  if (made == wanted) return {ItemState::whole, wanted};
  if (failed == wanted) return {ItemState::failed, wanted};
  throw Error(
      ErrorCode::configuration,
      fmt::format(
          "'{}' is of another plan, of other leaf files or of another version of wilt; choose another "
          "folder, or delete it to have it made anew",
          (made.empty() ? failure_file(item) : item_folder(item)).string()));
}

ItemState Batch::make(int number, const Monitor& monitor) {
  if (const ItemState now = state(number); now != ItemState::missing) return now;
  const Item item = plan_.item(number);
  try {
    Workshop workshop(item_folder(number));
    make_item(item, plan_.outputs(), fingerprints_->of(item), workshop.path(), leaves_, monitor);
    if (!workshop.rename_to(item_folder(number))) return state(number);
    return ItemState::whole;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::output || error.code() == ErrorCode::interrupted) throw;
    record_failure(number, error.code(), error.what());
  } catch (const std::bad_alloc&) {
    record_failure(number, ErrorCode::simulation, "there is no memory for it");
  } catch (const std::exception& error) {
    record_failure(number, ErrorCode::simulation, fmt::format("internal error: {}", error.what()));
  }
  return ItemState::failed;
}

void Batch::record_failure(int number, ErrorCode code, const std::string& reason) {
  const Item item = plan_.item(number);
  Json json = {{"item", number},
               {"fingerprint", fingerprints_->of(item)},
               {"code", static_cast<int>(code)},
               {"reason", without_folders(reason, item.leaf)}};
  json["chosen"] = Json::parse(chosen_json(item));
  write_file(failure_file(number).string(), json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string Batch::failure(int item) const {
  if (!fs::exists(failure_file(item))) return {};
  return Json::parse(read_file(failure_file(item).string()), nullptr, false).value("reason", "unknown");
}

void Batch::forget_failure(int item) const {
  std::error_code ignored;
  fs::remove(failure_file(item), ignored);
}

bool Batch::finish(const Monitor& monitor) {
  sweep(folder_ / "items");  // after workers that were killed
  std::vector<ItemState> states;
  std::string all = plan_.text();
  for (int item = 0; item < plan_.count(); ++item) {
    monitor.throw_if_cancelled();
    const auto [state, fingerprint] = find(item);
    if (state == ItemState::missing) return false;
    states.push_back(state);
    all += fmt::format("{} {}\n", static_cast<int>(state), fingerprint);
  }
  const std::string stamp = (folder_ / ".finished").string(), now = sha256(all) + "\n";
  if (fs::exists(stamp) && read_file(stamp) == now) return true;
  write_manifest(plan_, folder_, states, monitor);
  write_file(stamp, now);
  return true;
}

}  // namespace wilt
