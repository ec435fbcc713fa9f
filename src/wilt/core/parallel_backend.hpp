// What a library of threads does for parallel.hpp: there is one source per library (parallel_tbb.cpp,
// parallel_std.cpp), and parallel_threads.cpp builds on either. Private to these sources.
#pragma once

#include <functional>
#include <memory>

namespace wilt::detail {

/// Threads that may work at once now, the calling one among them: what the innermost ThreadLimit allows.
int threads_allowed();

/// Tasks beside what the calling thread does.
class Helpers {
 public:
  Helpers();
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  /// Has `task` called once, when a thread is free for it, at the latest in wait(). It must not throw.
  void run(const std::function<void()>& task);
  /// Returns when all tasks have; to be called before the destructor.
  void wait();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wilt::detail
