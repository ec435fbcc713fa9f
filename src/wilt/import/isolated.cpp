#include "wilt/import/isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "wilt/core/error.hpp"
#include "wilt/core/sanitized.hpp"

namespace wilt::detail {
namespace {

// The first byte of what the child sends; bytes or a message follow, then kEnd.
constexpr char kResult = 'r', kError = 'e', kFailure = 'f', kNoMemory = 'm', kEnd = '.';

constexpr int kPollMilliseconds = 50;

// What the process has mapped already: the child starts with as much. Bytes.
std::uint64_t mapped_now() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// Never above what the user has set.
void lower_limit(decltype(RLIMIT_CPU) resource, rlim_t wanted) {
  rlimit limit;
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, wanted);
  limit.rlim_max = std::min(limit.rlim_max, wanted + 1);
  ::setrlimit(resource, &limit);
}

void write_text(const char* path, const char* text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(file, text, std::strlen(text));
  ::close(file);
}

// The child's own state: limits, no printing, the usual ends of signals; it goes when its parent goes.
void settle_in_child(pid_t parent, rlim_t address_limit, int cpu_seconds) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C reaches the parent too, which decides
  std::signal(SIGTERM, SIG_DFL);
  lower_limit(RLIMIT_CPU, static_cast<rlim_t>(cpu_seconds));
  lower_limit(RLIMIT_CORE, 0);
  write_text("/proc/self/oom_score_adj", "1000");  // where memory runs out, this process goes first
  if (WILT_SANITIZED) return;
  lower_limit(RLIMIT_AS, address_limit);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(number, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

bool send(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

void send_answer(int pipe, char kind, std::string_view bytes) {
  if (send(pipe, {&kind, 1}) && send(pipe, bytes)) send(pipe, {&kEnd, 1});
}

void work_in_child(int pipe, const std::function<std::string()>& work) {
  try {
    send_answer(pipe, kResult, work());
  } catch (const Error& error) {
    send_answer(pipe, kError, static_cast<char>(error.code()) + std::string(error.what()));
  } catch (const std::bad_alloc&) {
    send_answer(pipe, kNoMemory, {});
  } catch (const std::exception& error) {
    send_answer(pipe, kFailure, error.what());
  } catch (...) {
    send_answer(pipe, kFailure, "an unknown exception");
  }
}

// A child and the pipe from it; both are gone when this is.
class Child {
 public:
  Child(pid_t id, int pipe) : id_(id), pipe_(pipe) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    wait();
    ::close(pipe_);
  }

  /// Appends what has come, waiting for it at most kPollMilliseconds; false at the end.
  bool receive(std::string& bytes) const {
    pollfd ready{pipe_, POLLIN, 0};
    const int count = ::poll(&ready, 1, kPollMilliseconds);
    if (count <= 0) return true;
    char block[1 << 16];
    const ssize_t length = ::read(pipe_, block, sizeof block);
    if (length > 0) bytes.append(block, static_cast<std::size_t>(length));
    return length > 0 || (length < 0 && errno == EINTR);
  }

  /// The signal that ended the child; 0: none, or it is not known.
  int wait() {
    if (id_ <= 0) return 0;
    int status = 0;
    pid_t ended = 0;
    do ended = ::waitpid(id_, &status, 0);
    while (ended < 0 && errno == EINTR);
    id_ = 0;
    return ended > 0 && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t id_;
  int pipe_;
};

[[noreturn]] void refuse(const std::string& reader, const std::string& what) {
  throw Error(ErrorCode::input, fmt::format("{} {}", reader, what));
}

constexpr const char* kRemedy =
    "the file is damaged, or meets a fault in that library: open it in Blender and export it anew, as "
    "triangles";

[[noreturn]] void refuse_end(const std::string& reader, int signal, const IsolationLimits& limits) {
  if (signal == SIGXCPU)
    refuse(reader, fmt::format("took more than {} s of processor time on it, the most that is allowed; {}",
                               limits.cpu_seconds, kRemedy));
  if (signal == SIGKILL)
    refuse(reader, "was killed (signal 9), probably because memory ran out; free some, or simplify the file");
  if (signal != 0)
    refuse(reader, fmt::format("crashed on it (signal {}, {}); {}", signal, ::strsignal(signal), kRemedy));
  refuse(reader, fmt::format("ended early on it; {}", kRemedy));
}

std::string unwrap(const std::string& reader, std::string answer, int signal, const IsolationLimits& limits) {
  if (answer.size() < 2 || answer.back() != kEnd) refuse_end(reader, signal, limits);
  answer.pop_back();
  const char kind = answer.front();
  answer.erase(0, 1);
  if (kind == kResult) return answer;
  if (kind == kNoMemory)
    refuse(reader, fmt::format("needs more memory for it than there is, or than the {} GB that are allowed; "
                               "simplify the file",
                               limits.memory >> 30));
  if (kind == kFailure || answer.empty()) refuse(reader, fmt::format("failed: {}", answer));
  throw Error(static_cast<ErrorCode>(static_cast<unsigned char>(answer.front())), answer.substr(1));
}

}  // namespace

std::string run_isolated(const std::string& reader, const std::function<std::string()>& work,
                         const Monitor& monitor, const IsolationLimits& limits) {
  monitor.throw_if_cancelled();
  const rlim_t address_limit = mapped_now() + limits.memory;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    refuse(reader, fmt::format("could not be started: {}", std::strerror(errno)));
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(ends[0]);
    settle_in_child(parent, address_limit, limits.cpu_seconds);
    work_in_child(ends[1], work);
    ::_exit(0);
  }
  const int reason = errno;
  ::close(ends[1]);
  Child child(id, ends[0]);
  if (id < 0) refuse(reader, fmt::format("could not be started: {}", std::strerror(reason)));
  const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(limits.seconds);
  std::string answer;
  while (child.receive(answer)) {
    monitor.throw_if_cancelled();
    if (std::chrono::steady_clock::now() > last)
      refuse(reader,
             fmt::format("took more than {} s on it, the most that is allowed; {}", limits.seconds, kRemedy));
  }
  const int signal = child.wait();
  return unwrap(reader, std::move(answer), signal, limits);
}

}  // namespace wilt::detail
