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
