// wilt: makes leaves wither. Parses the command line and turns errors into messages and exit codes.
#include <fmt/format.h>

#include <memory>
#include <new>
#include <sstream>

#include "checks.hpp"
#include "completion.hpp"
#include "interrupts.hpp"
#include "manual.hpp"
#include "parse_errors.hpp"
#include "terminal.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
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

// Lists a command by the first line of its description (the rest, its examples, stands in its own help) and
// an option by what it takes.
class BriefFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_positional() || option->get_items_expected_max() == 0) return "";
    std::string text = " " + value_name(*option);
    if (option->get_expected_max() > 1) text += " ...";
    return option->get_required() ? text + " REQUIRED" : text;
  }
  std::string make_subcommand(const CLI::App* verb) const override {
    const std::string description = verb->get_description();
    return fmt::format("  {:<12}{}\n", verb->get_name(), description.substr(0, description.find('\n')));
  }
};

void add_global_options(CLI::App& app, GlobalOptions& options) {
  app.add_flag("--json", options.json, "Machine-readable data on stdout");
  app.add_flag("-q,--quiet", options.quiet, "Only warnings and errors");
  app.add_flag("-v,--verbose", options.verbose, "More detail");
  app.add_option_function<std::string>(
         "--color",
         [&options](const std::string& when) {
           options.colour = when == "always"  ? Colour::always
                            : when == "never" ? Colour::never
                                              : Colour::automatic;
         },
         "auto, always or never (auto; NO_COLOR is respected)")
      ->check(one_of({"auto", "always", "never"}))
      ->type_name("WHEN");
}

// What is made of the command line's own definitions.
void add_texts(CLI::App& app) {
  const auto print = [](const std::string& text) {
    throw CLI::CallForVersion(text.substr(0, text.size() - 1), 0);
  };
  app.add_flag_callback(
      "--man", [&app, print] { print(manual(describe(app))); },
      "The manual page, and stop: wilt --man | man -l -");
  app.add_option_function<std::string>(
         "--completion", [&app, print](const std::string& shell) { print(completion(describe(app), shell)); },
         "The script by which a shell completes wilt's words, and stop: bash, fish or zsh")
      ->check(one_of(completed_shells()))
      ->type_name("SHELL");
}

int run(int argc, char** argv) {
  GlobalOptions options;
  CLI::App app(kIntroduction, "wilt");
  app.set_version_flag("--version", std::string("wilt ") + version());
  const auto formatter = std::make_shared<BriefFormatter>();
  formatter->column_width(34);
  app.formatter(formatter);
  app.get_option("--help")->description("This help, and stop");
  app.get_option("--version")->description("The version, and stop");
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
  add_batch(app, options);
  add_view(app, options);
  add_texts(app);
  const auto fail = [&](const std::string& message, ErrorCode code) {
    Terminal(options).error(message);
    return static_cast<int>(code);
  };
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    try {
      app.parse(argc, argv);
      if (app.get_subcommands().empty()) print_data(app.help());
    } catch (const CLI::Success& asked) {  // --help, --version
      std::ostringstream text;
      app.exit(asked, text, text);
      print_data(text.str());
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    return fail(explain(app, error, words), ErrorCode::configuration);
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
  wilt::cli::guard_standard_streams();
  wilt::cli::end_on_interrupt();
  return wilt::cli::run(argc, argv);
}
