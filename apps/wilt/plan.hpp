// What --dry-run says.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "terminal.hpp"
#include "wilt/run/leaf_request.hpp"

namespace CLI {
class App;
}

namespace wilt::cli {

/// Adds --dry-run.
void add_dry_run(CLI::App& verb, bool& dry_run);

/// Says on stdout what would be done ("wither ...", with `facts` for --json) and which files would be
/// written, new or in place of old ones.
void print_plan(const std::string& deed, nlohmann::ordered_json facts, const std::vector<std::string>& files,
                const GlobalOptions& options);

/// The vertices that the leaf would have, about: its file is read, a large mesh is not made.
int planned_vertices(const LeafRequest& request, const Monitor& monitor);

}  // namespace wilt::cli
