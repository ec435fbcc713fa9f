// Work in several processes, so that one that crashes or is killed takes one piece of work with it and no
// more.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wilt/core/monitor.hpp"

namespace wilt {

/// What became of a piece of work: what work() returned, or how its process ended.
struct WorkReport {
  int piece = 0;
  std::string answer;
  std::string death;  ///< "was killed by signal 9 (Killed)"; empty: it lives
};

/// Work on a piece, in a child process; the monitor tells it to stop. It must not throw.
using Work = std::function<std::string(int piece, const Monitor& monitor)>;

/// Calls work() for every piece in one of `processes` child processes, which live on for the next piece, and
/// done() here after each. A child that dies is replaced and its piece tried again; the piece that kills a
/// second one is reported as dead. To be called before any parallel loop: a fork copies no threads. When the
/// monitor says stop, the children are told, what they still answer is handed on, and false is returned.
/// Throws Error{simulation} when no process can be started.
bool work_in_processes(const std::vector<int>& pieces, int processes, const Work& work,
                       const std::function<void(const WorkReport&)>& done, const Monitor& monitor);

}  // namespace wilt
