// Work in a process of its own: what it returns, how it can end, and that nothing of it stays.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/core/sanitized.hpp"
#include "wilt/import/isolated.hpp"

namespace wilt::detail {
namespace {

std::string refusal(const std::function<std::string()>& work, const IsolationLimits& limits = {}) {
  try {
    run_isolated("the reader", work, {}, limits);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "";
}

std::size_t open_descriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

// Oracle: the bytes themselves, some that fit a pipe and many that do not, zeros and ends among them.
TEST(Isolated, GivesTheBytesBack) {
  EXPECT_EQ(run_isolated("the reader", [] { return std::string(); }), "");
  std::string many(5'000'001, '.');
  for (std::size_t i = 0; i < many.size(); i += 3) many[i] = static_cast<char>(i);
  EXPECT_EQ(run_isolated("the reader", [&] { return many; }), many);
}

TEST(Isolated, PassesErrorsOnUnchanged) {
  try {
    run_isolated("the reader", []() -> std::string { throw Error(ErrorCode::output, "as it was said"); });
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_STREQ(error.what(), "as it was said");
  }
  EXPECT_EQ(refusal([]() -> std::string { throw std::runtime_error("odd"); }), "the reader failed: odd");
}

TEST(Isolated, SaysHowItsWorkEnded) {
  EXPECT_NE(refusal([]() -> std::string { std::abort(); }).find("crashed on it (signal 6"),
            std::string::npos);
  EXPECT_NE(refusal([]() -> std::string { ::_exit(0); }).find("ended early"), std::string::npos);
  const auto spin = []() -> std::string {
    const volatile bool on = true;
    while (on) {
    }
    return "";
  };
  EXPECT_NE(refusal(spin, {std::uint64_t{1} << 30, 1, 60}).find("1 s of processor time"), std::string::npos);
  const auto sleep = [] {
    std::this_thread::sleep_for(std::chrono::seconds(60));
    return std::string();
  };
  EXPECT_NE(refusal(sleep, {std::uint64_t{1} << 30, 1, 1}).find("more than 1 s on it"), std::string::npos);
}

#if !WILT_SANITIZED
// Sanitizers print a crash of their own and map more than any limit.
TEST(Isolated, BoundsMemoryAndSurvivesACrash) {
  const auto hungry = [] { return std::string(std::size_t{3} << 30, 'x'); };
  EXPECT_NE(refusal(hungry, {std::uint64_t{1} << 30, 60, 60}).find("1 GB that are allowed"),
            std::string::npos);
  const auto crash = []() -> std::string {
    std::raise(SIGSEGV);
    return "";
  };
  EXPECT_NE(refusal(crash).find("crashed on it (signal 11, Segmentation fault)"), std::string::npos);
}
#endif

// Oracle: the table of open files, and the system's word that there is no child.
TEST(Isolated, LeavesNoChildAndNoDescriptor) {
  const std::size_t before = open_descriptors();
  run_isolated("the reader", [] { return std::string("x"); });
  refusal([]() -> std::string { std::abort(); });
  Monitor monitor;
  int asked = 0;
  monitor.cancelled = [&asked] { return ++asked > 2; };
  try {
    run_isolated(
        "the reader", [] { return ::pause(), std::string(); }, monitor);
    FAIL() << "it was not interrupted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

// Threads that allocate and throw all the time, as those of a batch do: every child must come to its end.
TEST(Isolated, WorksWhileOtherThreadsRun) {
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&stop] {
      while (!stop) {
        try {
          throw std::runtime_error(std::string(1000, 'x'));
        } catch (const std::exception&) {
        }
      }
    });
  for (int i = 0; i < 50; ++i) {
    const auto work = [i]() -> std::string {
      if (i % 2 == 0) throw Error(ErrorCode::input, "even");
      return std::string(std::size_t(100'000), 'y');
    };
    if (i % 2 == 0)
      EXPECT_EQ(refusal(work), "even");
    else
      EXPECT_EQ(run_isolated("the reader", work).size(), 100'000u);
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace wilt::detail
