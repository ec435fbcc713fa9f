#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "wilt/batch/worker_processes.hpp"

namespace wilt {
namespace {

std::vector<int> up_to(int count) {
  std::vector<int> pieces(static_cast<std::size_t>(count));
  std::iota(pieces.begin(), pieces.end(), 0);
  return pieces;
}

// Oracle: what the same function gives here.
TEST(WorkInProcesses, AnswersEveryPieceOnceInOtherProcesses) {
  std::map<int, std::string> answers;
  const auto work = [](int piece, const Monitor&) {
    return std::to_string(::getpid()) + ' ' + std::string(static_cast<std::size_t>(piece) * 1000, 'x');
  };
  const bool all = work_in_processes(up_to(50), 3, work,
                                     [&](const WorkReport& report) {
                                       EXPECT_TRUE(answers.emplace(report.piece, report.answer).second);
                                       EXPECT_EQ(report.death, "");
                                     },
                                     {});
  EXPECT_TRUE(all);
  ASSERT_EQ(answers.size(), 50u);
  std::set<std::string> workers;
  for (const auto& [piece, answer] : answers) {
    const std::string process = answer.substr(0, answer.find(' '));
    EXPECT_EQ(answer.size(), process.size() + 1 + static_cast<std::size_t>(piece) * 1000);
    EXPECT_NE(process, std::to_string(::getpid()));
    workers.insert(process);
  }
  EXPECT_LE(workers.size(), 3u);  // they live on for the next piece
}

TEST(WorkInProcesses, ReportsThePieceThatKillsItsProcessTwiceAndGoesOn) {
  std::map<int, WorkReport> reports;
  const auto work = [](int piece, const Monitor&) {
    if (piece == 3) ::raise(SIGKILL);
    if (piece == 5) ::_exit(7);
    return std::string("done");
  };
  EXPECT_TRUE(work_in_processes(up_to(10), 2, work,
                                [&](const WorkReport& report) { reports[report.piece] = report; }, {}));
  ASSERT_EQ(reports.size(), 10u);
  for (const auto& [piece, report] : reports)
    EXPECT_EQ(report.answer, piece == 3 || piece == 5 ? "" : "done") << piece;
  EXPECT_EQ(reports[3].death, "its process was killed by signal 9 (Killed)");
  EXPECT_EQ(reports[5].death, "its process ended with 7");
}

TEST(WorkInProcesses, TriesAPieceAgainWhenItsProcessWasKilledByOthers) {
  const std::string mark = testing::TempDir() + "/killed-once-" + std::to_string(::getpid());
  const auto work = [&mark](int piece, const Monitor&) {
    if (piece == 1 && !std::filesystem::exists(mark)) {
      std::filesystem::create_directory(mark);
      ::raise(SIGKILL);
    }
    return std::string("done");
  };
  int done = 0;
  work_in_processes(up_to(4), 2, work, [&](const WorkReport& report) { done += report.answer == "done"; },
                    {});
  EXPECT_EQ(done, 4);
  std::filesystem::remove(mark);
}

TEST(WorkInProcesses, TellsTheChildrenToStopAndHandsOnWhatTheyAnswer) {
  const auto work = [](int piece, const Monitor& monitor) {
    if (piece == 0) return std::string("first");
    while (!monitor.stop_requested()) ::usleep(1000);
    return std::string("stopped");
  };
  std::vector<std::string> answers;
  Monitor monitor;
  monitor.cancelled = [&answers] { return !answers.empty(); };
  const bool all = work_in_processes(
      up_to(100), 2, work, [&](const WorkReport& report) { answers.push_back(report.answer); }, monitor);
  EXPECT_FALSE(all);
  ASSERT_GE(answers.size(), 2u);
  EXPECT_LE(answers.size(), 3u);
  EXPECT_EQ(answers.front(), "first");
  EXPECT_EQ(answers.back(), "stopped");
}

}  // namespace
}  // namespace wilt
