// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <functional>
#include <memory>

namespace wilt {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), at least `grain` long, on several
/// threads.
///
/// A body may write only what belongs to its own range; then the result is the same for any number of
/// threads. Exceptions thrown by a body reach the caller. Serial when built without WILT_THREADS.
void parallel_for(int count, int grain, const std::function<void(int begin, int end)>& body);

/// The sum of block_sum(begin, end) over the fixed blocks [0, block), [block, 2 block), ...
///
/// Blocks are added in ascending order, so the rounding is the same for any number of threads.
double parallel_sum(int count, int block, const std::function<double(int begin, int end)>& block_sum);

/// Threads that stay awake between short loops.
///
/// A sleeping thread takes some 30 us to wake, as long as a pass over ten thousand vertices; while a Crew
/// lives its helpers spin from one loop to the next instead. So let it live for one computation, and its
/// loops follow each other closely. Helpers are asked for at the first loop that needs them and join when
/// they can; the calling thread never waits for one that has not come. Serial when built without
/// WILT_THREADS.
class Crew {
 public:
  Crew();
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Calls body(i) for every i in [0, count), count < 2^24; the calls may write only what belongs to their i
  /// and must not throw.
  void for_each(int count, const std::function<void(int i)>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// While one lives, parallel loops use at most `threads` threads (0: all that the machine has).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wilt
