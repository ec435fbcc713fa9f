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

std::string time_left(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s left", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min left", seconds / 60.0);
  return fmt::format("{:.1f} h left", seconds / 3600.0);
}

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

bool Terminal::due(std::string_view stage, Clock::duration pause) {
  const Clock::time_point now = Clock::now();
  const bool is_new = stage != stage_;
  if (is_new) {
    stage_ = stage;
    stage_start_ = now;
  } else if (now - last_drawn_ < pause) {
    return false;
  }
  last_drawn_ = now;
  return true;
}

double Terminal::stage_seconds() const {
  return std::chrono::duration<double>(Clock::now() - stage_start_).count();
}

void Terminal::draw_bar(std::string_view stage, double fraction) {
  if (!due(stage, std::chrono::milliseconds(fraction < 1.0 ? 100 : 0))) return;
  const double f = std::clamp(fraction, 0.0, 1.0), elapsed = stage_seconds();
  show_bar(stage, f, f > 0.02 && elapsed > 0.5 ? time_left(elapsed * (1.0 - f) / f) : "");
}

void Terminal::count(std::string_view things, int done, int of) {
  if (quiet_) return;
  const bool last = done == of;
  if (!due(things, terminal_ ? std::chrono::milliseconds(last ? 0 : 100) : std::chrono::seconds(30))) return;
  const double elapsed = stage_seconds();
  std::string facts = fmt::format("{} of {}", done, of);
  if (done > 0 && elapsed > 0.5)
    facts += fmt::format(", {:.2g}/s, {}", done / elapsed, time_left(elapsed * (of - done) / done));
  if (terminal_) {
    show_bar(things, double(done) / of, facts);
  } else if (elapsed > 1.0) {
    say(fmt::format("{}: {}", things, facts));
  }
}

void Terminal::show_bar(std::string_view stage, double fraction, const std::string& facts) {
  const int filled = static_cast<int>(fraction * kBarWidth);
  print_message(fmt::format("\r\033[K{:<12} [{}{}] {:3.0f} %  {}", stage, std::string(filled, '='),
                            std::string(kBarWidth - filled, ' '), 100.0 * fraction, facts));
  std::fflush(stderr);
  bar_shown_ = true;
}

}  // namespace wilt::cli
