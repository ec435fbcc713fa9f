#include "interrupts.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "wilt/core/error.hpp"

namespace wilt::cli {
namespace {

// The one piece of global state: a signal handler can reach nothing else.
enum class Answer { end, ask, end_without_the_rest };
std::atomic<Answer> answer{Answer::end};
std::atomic<bool> requested{false};
static_assert(std::atomic<Answer>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void say(std::string_view message) {
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, message.data(), message.size());
}

extern "C" void on_interrupt(int) {
  Answer asked = Answer::ask;
  if (answer.compare_exchange_strong(asked, Answer::end_without_the_rest)) {
    requested = true;
    return;
  }
  if (isatty(STDERR_FILENO) != 0) say("\n");  // behind the progress bar
  say(asked == Answer::end ? "error: interrupted; nothing more was written\n"
                           : "error: interrupted again; what was not yet written is lost\n");
  ::_exit(static_cast<int>(ErrorCode::interrupted));
}

void handle(Answer what) {
  answer = what;
  requested = false;
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    const bool under_nohup = signal == SIGHUP && before.sa_handler == SIG_IGN;
    if (!under_nohup) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

void end_on_interrupt() {
  handle(Answer::end);
}

void ask_on_interrupt() {
  handle(Answer::ask);
}

bool interrupted() {
  return requested;
}

void go_on_after_interrupt() {
  requested = false;
}

}  // namespace wilt::cli
