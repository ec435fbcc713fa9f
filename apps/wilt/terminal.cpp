#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "wilt/core/printable.hpp"

namespace wilt::cli {
namespace {

// The one piece of global state: a signal handler can reach nothing else.
volatile std::sig_atomic_t interrupt_requested = 0;

extern "C" void on_interrupt(int) {
  interrupt_requested = 1;
}

bool wants_colour(Colour colour) {
  if (colour != Colour::automatic) return colour == Colour::always;
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

constexpr int kBarWidth = 24;

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

bool interrupted() {
  return interrupt_requested != 0;
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
  fmt::print(stderr, "{}\n", printable(message));
}

void Terminal::detail(std::string_view message) {
  if (verbose_) say(message);
}

void Terminal::warn(std::string_view message) {
  clear_bar();
  fmt::print(stderr, "{} {}\n", paint("warning:", "33"), printable(message));
}

void Terminal::error(std::string_view message) {
  clear_bar();
  fmt::print(stderr, "{} {}\n", paint("error:", "31"), printable(message));
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
  fmt::print(stderr, "\r\033[K");
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
  fmt::print(stderr, "\r\033[K{:<12} [{}{}] {:3.0f} %  {}", stage, std::string(filled, '='),
             std::string(kBarWidth - filled, ' '), 100.0 * f, left);
  std::fflush(stderr);
  bar_shown_ = true;
}

}  // namespace wilt::cli
