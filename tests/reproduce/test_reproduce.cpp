// The figures as a whole, on small leaves.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "csv.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/reproduce/reproduce.hpp"

namespace wilt {
namespace {

ReproduceOptions small() {
  ReproduceOptions options;
  options.vertices = 300;
  options.pictures = {64, 48, 1, 1};
  return options;
}

class InAFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("wilt-reproduce-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

const Claim& find(const std::vector<Claim>& claims, const std::string& figure, const std::string& id,
                  const std::string& model) {
  for (const Claim& claim : claims) {
    if (claim.figure == figure && claim.id == id && claim.model == model) return claim;
  }
  throw std::out_of_range(figure + " " + id + " " + model);
}

// Oracle: the contract of claims.csv: every claim once under each model; every file that is linked is there,
// under a name of its own.
TEST_F(InAFolder, EveryFigureHasItsFilesAndEveryClaimARowPerModel) {
  const std::vector<Claim> claims = reproduce(figure_names(), folder_, small());
  const auto rows = read_csv(read_file(folder_ / "claims.csv"));
  ASSERT_EQ(rows.size(), claims.size() + 1);
  std::map<std::string, std::set<std::string>> models;
  for (std::size_t r = 1; r < rows.size(); ++r)
    EXPECT_TRUE(models[rows[r][0] + " " + rows[r][1]].insert(rows[r][3]).second) << rows[r][0] << rows[r][1];
  for (const auto& [claim, of] : models) EXPECT_EQ(of, (std::set<std::string>{"cell", "paper"})) << claim;
  const std::string page = read_file(folder_ / "index.html");
  const std::regex source("src=\"([^\"]+)\"");
  std::set<std::string> files;
  for (std::sregex_iterator it(page.begin(), page.end(), source), end; it != end; ++it) {
    EXPECT_TRUE(files.insert((*it)[1]).second) << (*it)[1];
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / std::string((*it)[1]))) << (*it)[1];
  }
  EXPECT_GT(files.size(), 90U);
  std::set<std::string> figures;
  for (const Claim& claim : claims) figures.insert(claim.figure);
  EXPECT_EQ(figures.size(), figure_names().size());
  for (const char* model : {"paper", "cell"}) {
    EXPECT_EQ(verdict(find(claims, "fig15", "more-wrinkled", model)), Verdict::not_run);
    EXPECT_EQ(*find(claims, "fig10", "zero-at-zero", model).value, 0.0);
  }
}

// Oracle: Tables 1 and 2 as printed, typed in a second time in this room; and half of T H K.
TEST_F(InAFolder, TablesAreAsPrinted) {
  const std::vector<Claim> claims = reproduce({"table1", "table2"}, folder_, small());
  for (const char* model : {"paper", "cell"}) {
    EXPECT_EQ(*find(claims, "table1", "presets", model).value, 0.0);
    EXPECT_EQ(*find(claims, "table2", "forces", model).value, 0.0);
    EXPECT_EQ(*find(claims, "table1", "rate-is-thk", model).value, 0.5);
    EXPECT_EQ(verdict(find(claims, "table1", "rate-is-thk", model)), Verdict::does_not);
  }
}

// Oracle: the bytes on one thread.
TEST_F(InAFolder, NumbersDoNotDependOnThreads) {
  const auto bytes = [&](int threads) {
    const ThreadLimit limit(threads);
    reproduce({"fig9", "fig14"}, folder_, small());
    return read_file(folder_ / "claims.csv") + read_file(folder_ / "fig9-forces-cell.csv") +
           read_file(folder_ / "fig14-cell-own-close.png");
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

// Oracle: the contract: what is done is kept, and the error says how much.
TEST_F(InAFolder, InterruptionKeepsWhatIsDone) {
  Monitor monitor;
  bool stop = false;
  monitor.progress = [&](std::string_view stage, double) { stop = stop || stage == "figure 9"; };
  monitor.cancelled = [&] { return stop; };
  try {
    reproduce({"table1", "fig2", "fig9"}, folder_, small(), monitor);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
    EXPECT_NE(std::string(error.what()).find("2 of 3 figures"), std::string::npos) << error.what();
  }
  const std::string html = read_file(folder_ / "index.html");
  EXPECT_NE(html.find("id=\"fig2\""), std::string::npos);
  EXPECT_EQ(html.find("id=\"fig9\""), std::string::npos);
}

TEST(ChosenFigures, AreInTheOrderOfTheReportAndOnceEach) {
  EXPECT_EQ(chosen_figures({"fig10", "table1", "fig10"}), (std::vector<std::string>{"table1", "fig10"}));
  EXPECT_EQ(chosen_figures({}), figure_names());
  EXPECT_EQ(chosen_figures({"fig2", "all"}), figure_names());
  try {
    chosen_figures({"tabel1"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    EXPECT_NE(std::string(error.what()).find("did you mean 'table1'?"), std::string::npos);
  }
}

TEST(Viridis, HasItsEndsAndIsMonotoneInLightness) {
  EXPECT_NEAR(viridis(0.0)[2] * 255, 84, 1e-9);
  EXPECT_NEAR(viridis(2.0)[0] * 255, 253, 1e-9);
  double last = -1.0;
  for (int k = 0; k <= 100; ++k) {
    const double lightness = viridis(k / 100.0).dot(Vec3(0.2126, 0.7152, 0.0722));
    EXPECT_GT(lightness, last);
    last = lightness;
  }
}

}  // namespace
}  // namespace wilt
