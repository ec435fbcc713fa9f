#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

// Oracle: the serial loop.
TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int count : {0, 1, 7, 1000}) {
    std::vector<int> visits(count, 0);
    parallel_for(count, 16, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

// Oracle: the same sum with one thread, bit for bit, of terms whose order matters.
TEST(ParallelSum, DoesNotDependOnTheNumberOfThreads) {
  const auto block = [](int begin, int end) {
    double sum = 0.0;
    for (int i = begin; i < end; ++i) sum += std::sin(i) * std::pow(10.0, i % 17);
    return sum;
  };
  double one;
  {
    const ThreadLimit limit(1);
    one = parallel_sum(100000, 64, block);
  }
  for (const int threads : {2, 3, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(parallel_sum(100000, 64, block), one);
  }
}

TEST(ParallelFor, HandsTheBodysExceptionToTheCaller) {
  EXPECT_THROW(parallel_for(1000, 1,
                            [](int begin, int) {
                              if (begin == 500) throw std::runtime_error("stop");
                            }),
               std::runtime_error);
}

// Negative control of every test that compares thread counts: a limit of one keeps the loop on its caller.
TEST(ThreadLimit, OfOneKeepsTheLoopOnTheCallingThread) {
  const ThreadLimit limit(1);
  std::atomic<int> elsewhere = 0;
  const auto here = std::this_thread::get_id();
  parallel_for(64, 1, [&](int, int) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // long enough for others to come
    if (std::this_thread::get_id() != here) ++elsewhere;
  });
  EXPECT_EQ(elsewhere, 0);
}

}  // namespace
}  // namespace wilt
