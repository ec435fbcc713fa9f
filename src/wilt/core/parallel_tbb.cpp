#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "wilt/core/parallel.hpp"

namespace wilt {

void parallel_for(int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  if (count <= grain) return body(0, count);
  tbb::parallel_for(tbb::blocked_range<int>(0, count, grain),
                    [&](const tbb::blocked_range<int>& range) { body(range.begin(), range.end()); });
}

double parallel_sum(int count, int block, const std::function<double(int, int)>& block_sum) {
  if (count <= 0) return 0.0;
  const int blocks = (count + block - 1) / block;
  std::vector<double> sums(blocks);
  parallel_for(blocks, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) sums[i] = block_sum(i * block, std::min(count, (i + 1) * block));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

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
