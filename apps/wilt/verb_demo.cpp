// wilt demo: no input; a withered maple leaf, its pictures, and what to try next.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "interrupts.hpp"
#include "run.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/render/contact_sheet.hpp"
#include "wilt/run/result_files.hpp"

namespace wilt::cli {
namespace {

constexpr int kSheetWidth = 480, kSheetHeight = 360;

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(ErrorCode::output, fmt::format("cannot write into '{}': {}; choose another folder",
                                               folder.string(), error.message()));
}

// Four stages from fresh to dry.
Image stages(ResultFiles& files) {
  std::vector<Image> images;
  for (int k = 0; k < 4; ++k)
    images.push_back(files.picture(files.last_frame() * k / 3, kSheetWidth, kSheetHeight));
  return contact_sheet(images, 4);
}

void run(const std::string& folder_name, const GlobalOptions& options) {
  const std::filesystem::path folder(folder_name);
  make_folder(folder);
  Terminal terminal(options);
  LeafRequest request;
  request.leaf = "maple";
  request.read.vertices = 4000;
  Config config = default_config(species("maple"));
  config.vertices = *request.read.vertices;
  WitheredLeaf withered = wither(request, config, terminal);
  if (withered.result.interrupted) throw Error(ErrorCode::interrupted, "interrupted; nothing was written");
  end_on_interrupt();

  const std::string clip = (folder / "maple.glb").string(), picture = (folder / "maple.png").string(),
                    sheet = (folder / "stages.png").string(), report = (folder / "report.json").string();
  ResultFiles files(withered, terminal.monitor());
  files.write(clip);
  write_file(report, report_of(withered));
  files.write(picture);
  write_image(sheet, stages(files));
  print_data(
      fmt::format("A maple leaf has withered.\n"
                  "  {:<34} plays in Blender (File > Import > glTF) and three.js\n"
                  "  {:<34} what it looks like now\n"
                  "  {:<34} from fresh to dry\n"
                  "  {:<34} steps and figures\n"
                  "\n"
                  "Next, your own:\n"
                  "  wilt simulate grape -o grape.glb\n"
                  "  wilt simulate drawing.svg -o mine.glb\n",
                  clip, picture, sheet, report));
}

}  // namespace

void add_demo(CLI::App& app, const GlobalOptions& options) {
  const auto folder = std::make_shared<std::string>("wilt-demo");
  CLI::App* verb = app.add_subcommand("demo",
                                      "A withered maple leaf and its pictures, in seconds; needs no input\n\n"
                                      "Examples:\n"
                                      "  wilt demo\n"
                                      "  wilt demo -o ~/leaf\n");
  verb->add_option("-o,--output", *folder, "Folder to write to (wilt-demo)")->type_name("DIR");
  verb->callback([folder, &options] { run(*folder, options); });
}

}  // namespace wilt::cli
