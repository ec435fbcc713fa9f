#include "terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "interrupts.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/printable.hpp"

namespace wilt::cli {
namespace {

// A message that nobody can be given is not worth an error.
void print_message(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

bool wants_colour(Colour colour) {
  if (colour != Colour::automatic) return colour == Colour::always;
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

constexpr int kBarWidth = 24;

}  // namespace

void guard_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Opened the wrong way round, so that whoever uses it is told. It takes the lowest number that is free.
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

void print_data(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  throw Error(ErrorCode::output,
              fmt::format("cannot write to the standard output: {}; send it elsewhere (> FILE)",
                          std::strerror(errno)));
}

Terminal::Terminal(const GlobalOptions& options)
    : quiet_(options.quiet),
      verbose_(options.verbose),
      terminal_(isatty(STDERR_FILENO) != 0),
      coloured_(wants_colour(options.colour)) {}

Terminal::~Terminal() {
  clear_bar();
}

std::string Terminal::paint(std::string_view text, const char* code) const {
  return coloured_ ? fmt::format("\033[{}m{}\033[0m", code, text) : std::string(text);
}

void Terminal::say(std::string_view message) {
  if (quiet_) return;
  clear_bar();
  print_message(fmt::format("{}\n", printable(message)));
}

void Terminal::detail(std::string_view message) {
  if (verbose_) say(message);
}

void Terminal::warn(std::string_view message) {
  clear_bar();
  print_message(fmt::format("{} {}\n", paint("warning:", "33"), printable(message)));
}

void Terminal::error(std::string_view message) {
  clear_bar();
  print_message(fmt::format("{} {}\n", paint("error:", "31"), printable(message)));
}

Monitor Terminal::monitor() {
  Monitor monitor;
  if (terminal_ && !quiet_) {
    monitor.progress = [this](std::string_view stage, double fraction) { draw_bar(stage, fraction); };
  }
  monitor.note = [this](std::string_view message) { say(message); };
  monitor.cancelled = interrupted;
  return monitor;
}

void Terminal::clear_bar() {
  if (!bar_shown_) return;
  print_message("\r\033[K");
  bar_shown_ = false;
}

void Terminal::draw_bar(std::string_view stage, double fraction) {
  const Clock::time_point now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  } else if (now - last_drawn_ < std::chrono::milliseconds(100) && fraction < 1.0) {
    return;
  }
  last_drawn_ = now;
  const double f = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  const int filled = static_cast<int>(f * kBarWidth);
  const std::string left =
      f > 0.02 && elapsed > 0.5 ? fmt::format("{:.0f} s left", elapsed * (1.0 - f) / f) : "";
  print_message(fmt::format("\r\033[K{:<12} [{}{}] {:3.0f} %  {}", stage, std::string(filled, '='),
                            std::string(kBarWidth - filled, ' '), 100.0 * f, left));
  std::fflush(stderr);
  bar_shown_ = true;
}

}  // namespace wilt::cli
