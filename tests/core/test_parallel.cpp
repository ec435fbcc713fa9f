#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
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

// Oracle: the serial loop; thousands of short loops one after the other, as in an iterative solver.
TEST(Crew, MakesEveryCallOnce) {
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    Crew crew;
    std::vector<int> visits(37, 0);
    for (int loop = 0; loop < 5000; ++loop) crew.for_each(loop % 38, [&](int i) { visits[i] += loop; });
    std::vector<int> expected(37, 0);
    for (int loop = 0; loop < 5000; ++loop) {
      for (int i = 0; i < loop % 38; ++i) expected[i] += loop;
    }
    EXPECT_EQ(visits, expected) << threads << " threads";
  }
}

TEST(Crew, HasHelpers) {
  const ThreadLimit limit(2);
  Crew crew;
  std::atomic<int> elsewhere = 0;
  const auto here = std::this_thread::get_id();
  for (int loop = 0; loop < 50 && elsewhere == 0; ++loop)
    crew.for_each(8, [&](int) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (std::this_thread::get_id() != here) ++elsewhere;
    });
  EXPECT_GT(elsewhere, 0);
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

// Whether `threads` calls of a loop can be under way at the same time: each waits for the others.
template <class Loop>
bool meet(int threads, const Loop& loop) {
  std::mutex mutex;
  std::condition_variable all_here;
  int here = 0;
  std::atomic<bool> met = true;
  loop([&] {
    std::unique_lock lock(mutex);
    ++here;
    all_here.notify_all();
    if (!all_here.wait_for(lock, std::chrono::seconds(20), [&] { return here >= threads; })) met = false;
  });
  return met;
}

// Oracle: calls that wait for each other end only when there is a thread for each; more than processors too.
TEST(ThreadLimit, GivesAsManyThreadsAsItSays) {
  for (const int threads : {2, 3, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_TRUE(meet(threads, [&](const auto& call) { parallel_for(threads, 1, [&](int, int) { call(); }); }))
        << threads;
    Crew crew;
    EXPECT_TRUE(meet(threads, [&](const auto& call) { crew.for_each(threads, [&](int) { call(); }); }))
        << threads;
  }
}

}  // namespace
}  // namespace wilt
