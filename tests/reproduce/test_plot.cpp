// Plots: the numbers beside them are the numbers in them.
#include <gtest/gtest.h>

#include <filesystem>

#include "csv.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/reproduce/plot.hpp"
#include "wilt/reproduce/program.hpp"

namespace wilt {
namespace {

Plot two_panels() {
  Plot plot{"test-plot", {{"first, with comma", "x", "y", {}}, {"second", "x", "y", {}}}, 2};
  plot.panels[0].series = {{"a", {0, 1, 2}, {0, 1, 4}}, {"it's", {0, 1}, {3, 1}}};
  plot.panels[1].series = {{"b", {5}, {7}, Series::Style::points}};
  return plot;
}

// Oracle: the plot's own numbers, read back by another reader.
TEST(Plot, CsvHoldsEveryPoint) {
  const auto rows = read_csv(plot_csv(two_panels()));
  ASSERT_EQ(rows.size(), 1U + 3 + 2 + 1);
  EXPECT_EQ(rows[3], (std::vector<std::string>{"1", "first, with comma", "1", "a", "2", "4"}));
  EXPECT_EQ(rows[6], (std::vector<std::string>{"2", "second", "1", "b", "5", "7"}));
}

class DrawnPlot : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("wilt-plot-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

// Oracle: drawing the script anew by hand gives the same bytes; the SVG holds the names as text.
TEST_F(DrawnPlot, CanBeDrawnAgainFromItsScript) {
  const PlotFiles files = write_plot(two_panels(), folder_);
  const std::string svg = read_file(folder_ / files.svg);
  EXPECT_NE(svg.find("it's"), std::string::npos);
  EXPECT_NE(svg.find("first, with comma"), std::string::npos);
  EXPECT_EQ(run_program("gnuplot", {files.script}, folder_).text, svg);
}

// Oracle: what was asked to be printed; a program that is not there is not an exception.
TEST_F(DrawnPlot, ProgramsGiveTheirOutputAndExitCode) {
  const ProgramOutput echo = run_program("echo", {"a b", "$HOME"}, folder_);
  EXPECT_TRUE(echo.started);
  EXPECT_EQ(echo.exit_code, 0);
  EXPECT_EQ(echo.text, "a b $HOME\n");
  EXPECT_EQ(run_program("pwd", {}, folder_).text, std::filesystem::canonical(folder_).string() + "\n");
  EXPECT_EQ(run_program("false", {}, folder_).exit_code, 1);
  EXPECT_FALSE(run_program("no-such-program-anywhere", {}, folder_).started);
}

// Oracle: the contract; the folder and the file are named.
TEST_F(DrawnPlot, CannotBeWrittenWhereThereIsNoFolder) {
  try {
    write_plot(two_panels(), folder_ / "missing");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos);
  }
}

}  // namespace
}  // namespace wilt
