// The verbs of the command line. Each adds its subcommand to the application; its callback does the work and
// throws wilt::Error when it cannot.
#pragma once

#include "terminal.hpp"

namespace CLI {
class App;
}

namespace wilt::cli {

void add_batch(CLI::App& app, const GlobalOptions& options);
void add_demo(CLI::App& app, const GlobalOptions& options);
void add_info(CLI::App& app, const GlobalOptions& options);
void add_leaf(CLI::App& app, const GlobalOptions& options);
void add_render(CLI::App& app, const GlobalOptions& options);
void add_reproduce(CLI::App& app, const GlobalOptions& options);
void add_simulate(CLI::App& app, const GlobalOptions& options);
void add_species(CLI::App& app, const GlobalOptions& options);
void add_veins(CLI::App& app, const GlobalOptions& options);
void add_view(CLI::App& app, const GlobalOptions& options);

}  // namespace wilt::cli
