#include "wilt/batch/worker_processes.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <memory>
#include <set>
#include <utility>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr int kPollMilliseconds = 100;

// All of `size` bytes, or false when the other end is gone.
template <class Transfer>
bool transfer_all(const Transfer& transfer, char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = transfer(bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool receive(int socket, void* data, std::size_t size) {
  return transfer_all([socket](char* bytes, std::size_t left) { return ::recv(socket, bytes, left, 0); },
                      static_cast<char*>(data), size);
}

bool send(int socket, const void* data, std::size_t size) {
  return transfer_all(
      [socket](char* bytes, std::size_t left) { return ::send(socket, bytes, left, MSG_NOSIGNAL); },
      static_cast<char*>(const_cast<void*>(data)), size);
}

// The life of a child: a piece in, an answer out, until the parent hangs up. Ctrl-C at the terminal reaches
// every process; the parent decides.
[[noreturn]] void serve(int socket, pid_t parent, const Work& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (const int number : {SIGINT, SIGHUP}) std::signal(number, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  Monitor monitor;
  monitor.cancelled = [socket] {
    pollfd line{socket, POLLRDHUP, 0};
    return ::poll(&line, 1, 0) > 0 && (line.revents & POLLRDHUP) != 0;
  };
  int piece = 0;
  while (receive(socket, &piece, sizeof piece)) {
    const std::string answer = work(piece, monitor);
    const std::uint64_t size = answer.size();
    if (!send(socket, &size, sizeof size) || !send(socket, answer.data(), answer.size())) break;
  }
  ::_exit(0);
}

class Child {
 public:
  explicit Child(const Work& work) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail();
    std::fflush(nullptr);  // or the child would print it again
    const pid_t parent = ::getpid();
    id_ = ::fork();
    if (id_ < 0) fail();
    if (id_ == 0) {
      ::close(ends[0]);
      serve(ends[1], parent, work);
    }
    ::close(ends[1]);
    socket_ = ends[0];
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    hang_up();  // closing is not enough: younger children have a copy
    ::close(socket_);
    if (id_ > 0) wait();
  }

  int socket() const { return socket_; }
  bool busy() const { return piece_ >= 0; }
  void give(int piece) {
    piece_ = piece;
    send(socket_, &piece, sizeof piece);  // should it be dead, the answer says so
  }
  /// No more pieces will come, and the work on this one is to stop.
  void hang_up() const { ::shutdown(socket_, SHUT_WR); }

  /// The answer to the piece that was given; waits for it.
  WorkReport report() {
    WorkReport report{std::exchange(piece_, -1), {}, {}};
    std::uint64_t size = 0;
    bool whole = receive(socket_, &size, sizeof size);
    if (whole) {
      report.answer.resize(size);
      whole = receive(socket_, report.answer.data(), size);
    }
    if (!whole) report.death = wait();
    return report;
  }
  bool dead() const { return id_ <= 0; }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorCode::simulation,
                fmt::format("no further process can be started: {}; use fewer --jobs", std::strerror(errno)));
  }

  std::string wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    if (WIFSIGNALED(status))
      return fmt::format("its process was killed by signal {} ({})", WTERMSIG(status),
                         ::strsignal(WTERMSIG(status)));
    return fmt::format("its process ended with {}", WEXITSTATUS(status));
  }

  pid_t id_ = -1;
  int socket_ = -1;
  int piece_ = -1;
};

}  // namespace

bool work_in_processes(const std::vector<int>& pieces, int processes, const Work& work,
                       const std::function<void(const WorkReport&)>& done, const Monitor& monitor) {
  std::deque<int> left(pieces.begin(), pieces.end());
  std::set<int> fatal;  // pieces whose process died once
  std::vector<std::unique_ptr<Child>> children(
      std::min(static_cast<std::size_t>(std::max(processes, 1)), pieces.size()));
  bool stopping = false;
  const auto stop = [&] {
    stopping = true;
    left.clear();
    for (const auto& child : children) {
      if (child) child->hang_up();
    }
  };
  const auto take = [&](const WorkReport& report) {
    const bool again = !report.death.empty() && !stopping && fatal.insert(report.piece).second;
    if (again) {
      left.push_back(report.piece);
    } else if (!(stopping && !report.death.empty())) {
      done(report);
    }
  };
  while (true) {
    if (!stopping && monitor.stop_requested()) stop();
    std::vector<pollfd> waiting;
    for (auto& child : children) {
      if (!left.empty() && (!child || !child->busy())) {
        if (!child || child->dead()) child = std::make_unique<Child>(work);
        child->give(left.front());
        left.pop_front();
      }
      if (child && child->busy()) waiting.push_back({child->socket(), POLLIN, 0});
    }
    if (waiting.empty()) return !stopping;
    if (::poll(waiting.data(), waiting.size(), kPollMilliseconds) <= 0) continue;
    for (const auto& child : children) {
      const auto ready = std::find_if(waiting.begin(), waiting.end(), [&child](const pollfd& line) {
        return child && child->busy() && line.fd == child->socket() && line.revents != 0;
      });
      if (ready != waiting.end()) take(child->report());
    }
  }
}

}  // namespace wilt
