// wilt: makes leaves wither. Parses the command line and turns errors into messages and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <new>

#include "terminal.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/core/version.hpp"

namespace wilt::cli {
namespace {

constexpr const char* kIntroduction =
    "wilt makes leaves wither: it finds the veins, moves the water, wrinkles and curls the blade,\n"
    "and writes files that Blender, three.js and other tools open.\n"
    "\n"
    "Examples:\n"
    "  wilt demo                                  a withered maple leaf and its picture, in seconds\n"
    "  wilt simulate maple -o maple.glb           a leaf that plays in Blender\n"
    "  wilt simulate drawing.svg -o mine.glb      the same for your own drawing (or mesh)\n"
    "  wilt render maple.glb -o maple.mp4         a picture, a contact sheet or a film of it\n"
    "  wilt veins ivy -o veins.svg                only the veins\n"
    "  wilt COMMAND --help                        what a command takes\n";

// Lists a command by the first line of its description; the rest, its examples, stands in its own help.
class BriefFormatter : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App* verb) const override {
    const std::string description = verb->get_description();
    return fmt::format("  {:<12}{}\n", verb->get_name(), description.substr(0, description.find('\n')));
  }
};

void add_global_options(CLI::App& app, GlobalOptions& options) {
  static const std::map<std::string, Colour> kColours = {
      {"auto", Colour::automatic}, {"always", Colour::always}, {"never", Colour::never}};
  app.add_flag("--json", options.json, "Machine-readable data on stdout");
  app.add_flag("-q,--quiet", options.quiet, "Only warnings and errors");
  app.add_flag("-v,--verbose", options.verbose, "More detail");
  app.add_option("--color", options.colour, "auto, always or never (auto; NO_COLOR is respected)")
      ->transform(CLI::CheckedTransformer(kColours, CLI::ignore_case).description(""))
      ->type_name("WHEN");
}

// The words that CLI11 could not place, with the nearest that it knows.
std::string explain(const CLI::App& app, const CLI::ParseError& error,
                    const std::vector<std::string>& words) {
  const CLI::App* verb = &app;
  for (const CLI::App* sub : app.get_subcommands()) verb = sub;
  std::vector<std::string> verbs, flags;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(sub->get_name());
  for (const CLI::App* owner : {&app, verb}) {
    for (const CLI::Option* option : owner->get_options()) {
      for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    }
  }
  if (verb == &app && !words.empty() && words.front().rfind('-', 0) != 0)
    return fmt::format("unknown command '{}'{}; the commands are {}", words.front(),
                       did_you_mean(words.front(), verbs), fmt::join(verbs, ", "));
  for (const std::string& word : words) {
    const std::string flag = word.substr(0, word.find('='));
    if (flag.rfind("--", 0) == 0 && std::find(flags.begin(), flags.end(), flag) == flags.end())
      return fmt::format("unknown option '{}'{}; see `wilt {} --help`", flag, did_you_mean(flag, flags),
                         verb == &app ? "" : verb->get_name());
  }
  return fmt::format("{}; see `wilt {}--help`", error.what(), verb == &app ? "" : verb->get_name() + " ");
}

int run(int argc, char** argv) {
  GlobalOptions options;
  CLI::App app(kIntroduction, "wilt");
  app.set_version_flag("--version", std::string("wilt ") + version());
  const auto formatter = std::make_shared<BriefFormatter>();
  formatter->column_width(34);
  app.formatter(formatter);
  app.fallthrough();
  app.require_subcommand(0, 1);
  add_global_options(app, options);
  add_demo(app, options);
  add_species(app, options);
  add_leaf(app, options);
  add_veins(app, options);
  add_simulate(app, options);
  add_render(app, options);
  add_info(app, options);
  add_reproduce(app, options);
  const auto fail = [&](const std::string& message, ErrorCode code) {
    Terminal(options).error(message);
    return static_cast<int>(code);
  };
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return fail(explain(app, error, std::vector<std::string>(argv + 1, argv + argc)),
                ErrorCode::configuration);
  } catch (const Error& error) {
    return fail(error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory; try fewer --vertices or a smaller --size", ErrorCode::simulation);
  } catch (const std::exception& error) {
    return fail(error.what(), ErrorCode::simulation);
  }
}

}  // namespace
}  // namespace wilt::cli

int main(int argc, char** argv) {
  return wilt::cli::run(argc, argv);
}
