// LEAF on the command line, and the options that go with it.
#pragma once

#include <functional>
#include <string>

#include "wilt/run/leaf_request.hpp"

namespace CLI {
class App;
}

namespace wilt::cli {

/// Adds LEAF and the options that go with it to a verb. `all`: --leaf all was given.
void add_leaf_options(CLI::App& verb, LeafRequest& request, bool& all);

/// Adds --veins.
void add_veins_option(CLI::App& verb, LeafRequest& request);

/// Calls run(leaf, name) for the leaf, or for every one of a photo: `leaf` asks for that one alone, and
/// name() turns a result's name into that leaf's: of `all`, leaf.glb becomes leaf-2.glb; an empty name stays
/// empty.
void for_each_leaf(
    const LeafRequest& request, bool all,
    const std::function<void(const LeafRequest& leaf,
                             const std::function<std::string(const std::string&)>& name)>& run);

}  // namespace wilt::cli
