// What the user sees: messages and a progress bar on stderr, data on stdout.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "wilt/core/monitor.hpp"

namespace wilt::cli {

enum class Colour { automatic, always, never };

/// Options that every verb takes.
struct GlobalOptions {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  Colour colour = Colour::automatic;
  int threads = 0;  ///< 0: all
};

/// Writes to stderr; a progress bar only when it is a terminal.
class Terminal {
 public:
  explicit Terminal(const GlobalOptions& options);
  ~Terminal();

  void say(std::string_view message);     ///< unless quiet
  void detail(std::string_view message);  ///< when verbose
  void warn(std::string_view message);    ///< always
  void error(std::string_view message);   ///< always

  /// How many of a long row of things are done: a bar with rate and time left, or, where there is no
  /// terminal, a line every half minute.
  void count(std::string_view things, int done, int of);

  /// Progress goes to the bar, notes to `say`, and Ctrl-C is what asks to stop.
  Monitor monitor();

 private:
  using Clock = std::chrono::steady_clock;

  void clear_bar();
  void draw_bar(std::string_view stage, double fraction);
  void show_bar(std::string_view stage, double fraction, const std::string& facts);
  bool due(std::string_view stage, Clock::duration pause);  ///< since the last time; begins a new stage
  double stage_seconds() const;
  std::string paint(std::string_view text, const char* code) const;

  bool quiet_, verbose_, terminal_, coloured_;
  bool bar_shown_ = false;
  std::string stage_;
  Clock::time_point stage_start_, last_drawn_;
};

/// To be called first. A standard stream that is closed stays so (no file that is opened later takes its
/// number), and a write that cannot be done is told to the writer instead of ending the program.
void guard_standard_streams();

/// Data for stdout, all of it. Throws Error{output} when stdout takes no more.
void print_data(std::string_view text);

}  // namespace wilt::cli
