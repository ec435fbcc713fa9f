#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <optional>
#include <thread>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/parallel_backend.hpp"

namespace wilt {

double parallel_sum(int count, int block, const std::function<double(int, int)>& block_sum) {
  if (count <= 0) return 0.0;
  const int blocks = (count + block - 1) / block;
  std::vector<double> sums(blocks);
  parallel_for(blocks, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) sums[i] = block_sum(i * block, std::min(count, (i + 1) * block));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// The loop that is under way is one word: its number, how many calls it has, and which comes next. Whoever
// takes a call from it by adding 1 knows all three at once, and the caller starts no other loop before all
// calls have returned, so a helper that comes late takes nothing.
struct Crew::Impl {
  static constexpr int kBits = 24;
  static constexpr std::uint64_t kMask = (1u << kBits) - 1;
  static constexpr int kSpins = 2000;  // looks at the word before the processor is offered to others

  std::atomic<std::uint64_t> word{0};
  std::atomic<int> finished{0};
  std::atomic<bool> over{false};
  const std::function<void(int)>* body = nullptr;
  std::optional<detail::Helpers> helpers;  // made at the first loop that needs them

  // Makes calls until none is left.
  void work() {
    for (;;) {
      const std::uint64_t seen = word.load(std::memory_order_acquire);
      if ((seen & kMask) >= (seen >> kBits & kMask)) return;
      const std::uint64_t taken = word.fetch_add(1, std::memory_order_acq_rel);
      if ((taken & kMask) >= (taken >> kBits & kMask)) return;
      (*body)(static_cast<int>(taken & kMask));
      finished.fetch_add(1, std::memory_order_release);
    }
  }
  void help() {
    for (int spins = 0; !over.load(std::memory_order_acquire); ++spins) {
      const std::uint64_t seen = word.load(std::memory_order_acquire);
      if ((seen & kMask) < (seen >> kBits & kMask)) {
        work();
        spins = 0;
      }
      if (spins > kSpins) std::this_thread::yield();
    }
  }
  void call_helpers() {
    helpers.emplace();
    for (int k = detail::threads_allowed(); k > 1; --k) helpers->run([this] { help(); });
  }
};

Crew::Crew() : impl_(std::make_unique<Impl>()) {}

Crew::~Crew() {
  impl_->over.store(true, std::memory_order_release);
  if (impl_->helpers) impl_->helpers->wait();
}

void Crew::for_each(int count, const std::function<void(int)>& body) {
  if (count <= 1) {
    if (count == 1) body(0);
    return;
  }
  if (!impl_->helpers) impl_->call_helpers();
  impl_->body = &body;
  impl_->finished.store(0, std::memory_order_relaxed);
  const std::uint64_t loop = (impl_->word.load(std::memory_order_relaxed) >> 2 * Impl::kBits) + 1;
  impl_->word.store(loop << 2 * Impl::kBits | static_cast<std::uint64_t>(count) << Impl::kBits,
                    std::memory_order_release);
  impl_->work();
  for (int spins = 0; impl_->finished.load(std::memory_order_acquire) < count; ++spins) {
    if (spins > Impl::kSpins) std::this_thread::yield();
  }
}

}  // namespace wilt
