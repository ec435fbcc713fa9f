// For the thread sanitizer, which sees every start, end and hand-over of std::thread but none of oneTBB's.
#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/parallel_backend.hpp"

namespace wilt {
namespace {

std::atomic<int> limit{0};          // of the innermost ThreadLimit; 0: none
thread_local bool in_loop = false;  // a loop within a loop stays on its thread

}  // namespace

namespace detail {

// At least 4 where nothing limits them: races show on a small machine too.
int threads_allowed() {
  const int most = limit.load();
  return most > 0 ? most : std::max(4, static_cast<int>(std::thread::hardware_concurrency()));
}

struct Helpers::Impl {
  std::vector<std::thread> threads;
};

Helpers::Helpers() : impl_(std::make_unique<Impl>()) {}
Helpers::~Helpers() = default;
void Helpers::run(const std::function<void()>& task) {
  impl_->threads.emplace_back(task);
}
void Helpers::wait() {
  for (std::thread& thread : impl_->threads) thread.join();
  impl_->threads.clear();
}

}  // namespace detail

// Short loops are split too, whatever the grain: races show on small meshes.
void parallel_for(int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  const int most = detail::threads_allowed();
  const int size = std::max(1, std::min(grain, count / most));
  const int parts = (count - 1) / size + 1;
  const int threads = std::min(parts, most);
  if (threads <= 1 || in_loop) return body(0, count);
  std::atomic<int> next{0};  // hands out parts and nothing else: relaxed, so that it hides no race of theirs
  std::vector<std::exception_ptr> thrown(threads);
  const auto work = [&](int thread) {
    in_loop = true;
    try {
      for (int part; (part = next.fetch_add(1, std::memory_order_relaxed)) < parts;)
        body(part * size, std::min(count, (part + 1) * size));
    } catch (...) {
      thrown[thread] = std::current_exception();
    }
    in_loop = false;
  };
  detail::Helpers helpers;
  for (int thread = 1; thread < threads; ++thread) helpers.run([&work, thread] { work(thread); });
  work(0);
  helpers.wait();
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

struct ThreadLimit::Impl {
  int before;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) impl_ = std::make_unique<Impl>(Impl{limit.exchange(threads)});
}

ThreadLimit::~ThreadLimit() {
  if (impl_) limit.store(impl_->before);
}

}  // namespace wilt
