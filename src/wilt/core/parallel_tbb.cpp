#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>

#include "wilt/core/parallel.hpp"
#include "wilt/core/parallel_backend.hpp"

namespace wilt {
namespace {

int limit_now() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

// The arena that a thread begins in has a place per processor; only a limit above that needs one of its own.
bool needs_an_arena() {
  return limit_now() > tbb::this_task_arena::max_concurrency();
}

}  // namespace

void parallel_for(int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  if (count <= grain) return body(0, count);
  const auto loop = [&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, count, grain),
                      [&](const tbb::blocked_range<int>& range) { body(range.begin(), range.end()); });
  };
  if (needs_an_arena()) return tbb::task_arena(limit_now()).execute(loop);
  loop();
}

namespace detail {

int threads_allowed() {
  return needs_an_arena() ? limit_now() : std::min(limit_now(), tbb::this_task_arena::max_concurrency());
}

struct Helpers::Impl {
  tbb::task_arena arena =
      needs_an_arena() ? tbb::task_arena(limit_now()) : tbb::task_arena(tbb::task_arena::attach());
  tbb::task_group group;
};

Helpers::Helpers() : impl_(std::make_unique<Impl>()) {}
Helpers::~Helpers() = default;
void Helpers::run(const std::function<void()>& task) {
  impl_->arena.execute([&] { impl_->group.run(task); });
}
void Helpers::wait() {
  impl_->arena.execute([&] { impl_->group.wait(); });
}

}  // namespace detail

// A copy of a control ends it, so it is made in place.
struct ThreadLimit::Impl {
  explicit Impl(int threads) : control(tbb::global_control::max_allowed_parallelism, std::size_t(threads)) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) impl_ = std::make_unique<Impl>(threads);
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace wilt
