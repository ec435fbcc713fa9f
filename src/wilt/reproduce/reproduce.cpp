#include "wilt/reproduce/reproduce.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/reproduce/figures.hpp"
#include "wilt/reproduce/report.hpp"

namespace wilt {
namespace {

struct Recipe {
  const char* name;
  Figure (*make)(Workshop& workshop);
};

constexpr std::array<Recipe, 14> kRecipes = {{{"table1", detail::table_1},
                                              {"table2", detail::table_2},
                                              {"fig2", detail::figure_2},
                                              {"fig5", detail::figure_5},
                                              {"fig6", detail::figure_6},
                                              {"fig7", detail::figure_7},
                                              {"fig8", detail::figure_8},
                                              {"fig9", detail::figure_9},
                                              {"fig10", detail::figure_10},
                                              {"fig11", detail::figure_11},
                                              {"fig12", detail::figure_12},
                                              {"fig13", detail::figure_13},
                                              {"fig14", detail::figure_14},
                                              {"fig15", detail::figure_15}}};

void make_writable_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorCode::output,
                fmt::format("cannot write into '{}': {}; choose another folder", folder,
                            error ? error.message() : "it is not a folder that you may write to"));
}

std::vector<Claim> claims_of(const std::vector<Figure>& figures) {
  std::vector<Claim> claims;
  for (const Figure& figure : figures)
    claims.insert(claims.end(), figure.claims.begin(), figure.claims.end());
  return claims;
}

}  // namespace

void ReproduceOptions::validate() const {
  const auto require = [](bool holds, const char* key, int value, const char* allowed) {
    if (!holds)
      throw Error(ErrorCode::configuration, fmt::format("{} is {}; allowed: {}", key, value, allowed));
  };
  require(vertices >= 200 && vertices <= 1'000'000, "vertices", vertices, "200 to 1000000");
  require(pictures.width >= 32 && pictures.width <= 8192, "width", pictures.width, "32 to 8192");
  require(pictures.height >= 32 && pictures.height <= 8192, "height", pictures.height, "32 to 8192");
  require(pictures.samples >= 1 && pictures.samples <= 65536, "samples", pictures.samples, "1 to 65536");
}

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Recipe& recipe : kRecipes) all.push_back(recipe.name);
    return all;
  }();
  return names;
}

std::vector<std::string> chosen_figures(const std::vector<std::string>& words) {
  const std::vector<std::string>& names = figure_names();
  for (const std::string& word : words) {
    if (word == "all" || std::find(names.begin(), names.end(), word) != names.end()) continue;
    throw Error(ErrorCode::configuration, fmt::format("unknown figure '{}'{}; there are all, {}", word,
                                                      did_you_mean(word, names), fmt::join(names, ", ")));
  }
  if (words.empty() || std::find(words.begin(), words.end(), "all") != words.end()) return names;
  std::vector<std::string> chosen;
  for (const std::string& name : names) {
    if (std::find(words.begin(), words.end(), name) != words.end()) chosen.push_back(name);
  }
  return chosen;
}

std::vector<Claim> reproduce(const std::vector<std::string>& figures, const std::string& folder,
                             const ReproduceOptions& options, const Monitor& monitor) {
  options.validate();
  require_gnuplot();
  make_writable_folder(folder);
  ReportFacts facts{options.vertices, options.pictures.seed, {}};
  Monitor noting = monitor;
  noting.note = [&](std::string_view message) {
    facts.notes.emplace_back(message);
    monitor.say(message);
  };
  Workshop workshop(folder, options.vertices, options.pictures, noting);
  std::vector<Figure> made;
  std::optional<Error> stopped;
  try {
    for (const Recipe& recipe : kRecipes) {
      if (std::find(figures.begin(), figures.end(), recipe.name) == figures.end()) continue;
      workshop.experiments().take_broken();
      made.push_back(recipe.make(workshop));
      withhold(made.back().claims, workshop.experiments().take_broken());
    }
  } catch (const Error& error) {
    stopped = Error(error.code(), fmt::format("{}; {} of {} figures are done and in '{}'", error.what(),
                                              made.size(), figures.size(), folder));
    facts.notes.push_back(
        fmt::format("Stopped ({}): {} of {} figures.", error.what(), made.size(), figures.size()));
  }
  const std::vector<Claim> claims = claims_of(made);
  write_file(folder + "/claims.csv", claims_csv(claims));
  write_file(folder + "/index.html", report_html(made, facts));
  if (stopped) throw *stopped;
  return claims;
}

}  // namespace wilt
