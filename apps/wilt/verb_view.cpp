// wilt view: the studio's page, served on this machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/process.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "checks.hpp"
#include "interrupts.hpp"
#include "page_server.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/run/leaf_request.hpp"

namespace wilt::cli {
namespace {

namespace fs = std::filesystem;
namespace process = boost::process;

struct Request {
  std::string file;
  int port = 0;
  bool no_browser = false;
};

// Where the page stands beside the program: installed, or built.
fs::path page_folder() {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* beside : {WILT_INSTALLED_STUDIO, "../studio"}) {
    std::error_code unknown;
    const fs::path folder = fs::weakly_canonical(program / beside, unknown);
    if (!unknown && fs::is_regular_file(folder / "index.html", unknown)) return folder;
  }
  throw Error(
      ErrorCode::input,
      "the studio's page is not there; make it with scripts/build-studio in wilt's sources, then install or "
      "build wilt again beside it");
}

// Throws Error{input} for a FILE that the page cannot take.
void check_leaf(const std::string& file) {
  static const std::vector<std::string> kinds = {".obj", ".ply",  ".stl", ".glb", ".gltf",
                                                 ".svg", ".json", ".png", ".jpg", ".jpeg"};
  std::error_code unknown;
  if (!fs::exists(file, unknown))
    throw Error(ErrorCode::input,
                fmt::format("'{}' is neither a species ({}) nor a file{}; check the path", file,
                            fmt::join(species_names(), ", "), did_you_mean(file, species_names())));
  if (!fs::is_regular_file(file, unknown))
    throw Error(ErrorCode::input, fmt::format("'{}' is a folder, a pipe or a device; give a file", file));
  if (std::find(kinds.begin(), kinds.end(), extension_of(file)) == kinds.end())
    throw Error(ErrorCode::input,
                fmt::format("the page takes {}, not '{}'; `wilt leaf` makes an .obj of other leaves",
                            fmt::join(kinds, " "), file));
  if (!std::ifstream(file, std::ios::binary).good())
    throw Error(ErrorCode::input, fmt::format("'{}' cannot be read; check its permissions", file));
}

// As it stands in a URL.
std::string percent_encoded(const std::string& text) {
  std::string encoded;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    encoded += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return encoded;
}

void open_browser(const std::string& address, Terminal& terminal) {
  const bool display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  const auto program = process::search_path("xdg-open");
  std::error_code failed;
  if (display && !program.empty()) {
    process::child child(program, address, process::std_in.close(), process::std_out > process::null,
                         process::std_err > process::null, failed);
    if (!failed) return child.detach();
  }
  terminal.say("no browser could be opened from here; open the address yourself");
}

void run(const Request& request, const GlobalOptions& options) {
  std::string fragment;
  ServedFiles files = files_under(page_folder());
  if (is_species(request.file)) {
    fragment = "#species=" + request.file;
  } else if (!request.file.empty()) {
    check_leaf(request.file);
    const std::string name = fs::path(request.file).filename().string();
    files["/leaf/" + name] = fs::absolute(request.file);
    fragment = "#file=" + percent_encoded(name);
  }
  Terminal terminal(options);
  ask_on_interrupt();
  const PageServer server(std::move(files), request.port);
  const std::string address = fmt::format("http://127.0.0.1:{}/{}", server.port(), fragment);
  const nlohmann::ordered_json facts = {{"url", address}, {"port", server.port()}};
  print_data(options.json ? facts.dump() + "\n" : address + "\n");
  terminal.say("the studio is served to this machine until Ctrl-C");
  if (!request.no_browser) open_browser(address, terminal);
  while (!interrupted() && server.serving()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  throw Error(ErrorCode::interrupted,
              "interrupted; the page is there no more; give the command again to go on");
}

}  // namespace

void add_view(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("view",
                         "The studio: wilt in the browser, live\n\n"
                         "Examples:\n"
                         "  wilt view                   serves the page on this machine and opens it\n"
                         "  wilt view maple             with this species\n"
                         "  wilt view drawing.svg       with a leaf of your own\n"
                         "  wilt view --port 8000 --no-browser\n");
  verb->add_option(
          "FILE", request->file,
          "A species, a mesh (.obj .ply .stl .glb .gltf), an outline\n(.svg .json) or a photo (.jpg .png)")
      ->check(offers(species_names()))
      ->type_name("FILE");
  verb->add_option("--port", request->port, "Port of the address, 1 to 65535 (any that is free)")
      ->check(whole_number(0, 65535))
      ->type_name("N");
  verb->add_flag("--no-browser", request->no_browser, "Only prints the address");
  verb->callback([request, &options] { run(*request, options); });
}

}  // namespace wilt::cli
