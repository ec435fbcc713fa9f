// wilt reproduce: the figures and tables of the paper anew, with a verdict on each claim.
#include <fmt/format.h>

#include <memory>

#include "arguments.hpp"
#include "checks.hpp"
#include "interrupts.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/reproduce/reproduce.hpp"

namespace wilt::cli {
namespace {

struct Request {
  std::vector<std::string> figures;
  std::string folder = "reproduction", size;
  ReproduceOptions options;
  int threads = 0;
};

std::vector<std::string> figure_words() {
  std::vector<std::string> words = figure_names();
  words.insert(words.begin(), "all");
  return words;
}

void run(Request& request, const GlobalOptions& options) {
  const std::vector<std::string> figures = chosen_figures(request.figures);
  if (!request.size.empty()) {
    const PixelSize size = parse_size(request.size, "--size takes pixels as WxH, for example 480x360");
    request.options.pictures.width = size.width;
    request.options.pictures.height = size.height;
  }
  const ThreadLimit limit(request.threads);
  Terminal terminal(options);
  ask_on_interrupt();
  const std::vector<Claim> claims = reproduce(figures, request.folder, request.options, terminal.monitor());
  if (options.json) {
    print_data(claims_json(claims));
    return;
  }
  for (const char* model : {"paper", "cell"}) {
    int holds = 0, all = 0;
    for (const Claim& claim : claims) {
      if (claim.model != model || verdict(claim) == Verdict::not_run) continue;
      ++all;
      holds += verdict(claim) == Verdict::comes_out ? 1 : 0;
    }
    terminal.say(fmt::format("{}: {} of {} claims come out", model, holds, all));
  }
  terminal.say(fmt::format("open {}/index.html", request.folder));
}

}  // namespace

void add_reproduce(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("reproduce",
                         "The figures and tables of the paper anew, with a verdict on each claim\n\n"
                         "Examples:\n"
                         "  wilt reproduce -o report                all of it: open report/index.html\n"
                         "  wilt reproduce fig10 table1 -o report   only these\n"
                         "  wilt reproduce fig7 -o report --size 960x720 --samples 64\n");
  verb->add_option("FIGURE", request->figures,
                   fmt::format("Any of all (default), {}", fmt::join(figure_names(), ", ")))
      ->check(offers(figure_words()));
  verb->add_option("-o,--output", request->folder, "Folder to write to (reproduction)")->type_name("DIR");
  verb->add_option("--size", request->size, "Pixels of a picture (480x360); the many small ones have half")
      ->type_name("WxH");
  verb->add_option("--samples", request->options.pictures.samples, "Samples per pixel (16)")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  verb->add_option("--vertices", request->options.vertices, "Vertices of every leaf (2000)")
      ->check(whole_number(200, 1000000))
      ->type_name("N");
  verb->add_option("--seed", request->options.pictures.seed, "Varies the individual leaves (1)")
      ->check(whole_number(0, kMostSeed))
      ->type_name("N");
  verb->add_option("--threads", request->threads, "Threads at most (all); results do not depend on it")
      ->type_name("N")
      ->check(whole_number(0, 1024));
  verb->callback([request, &options] { run(*request, options); });
}

}  // namespace wilt::cli
