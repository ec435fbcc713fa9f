// LEAF on the command line: a species or a file, and the options that go with it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "wilt/core/monitor.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/venation.hpp"

namespace CLI {
class App;
}

namespace wilt::cli {

inline constexpr int kDefaultVertices = 2000;  ///< of a species

struct LeafRequest {
  std::string leaf;             ///< a species' name or a file
  std::optional<int> vertices;  ///< absent: 2000, or a mesh file's own
  std::uint64_t seed = 1;
  std::string petiole;                            ///< "X,Y" or empty
  std::string which = "1";                        ///< --leaf: the N-th largest, or "all"
  std::optional<double> mm_per_pixel, threshold;  ///< of a photo
  std::string mask;                               ///< a picture's name, or empty
  bool scan = false;                              ///< a mesh's vertices are the points of a scan
  std::optional<double> mm_per_unit;              ///< of a scan
  std::string veins;  ///< a veins.json to take the veins from, or empty: they are found
};

/// Adds LEAF and the options that go with it to a verb.
void add_leaf_options(CLI::App& verb, LeafRequest& request);

/// Calls run(leaf, name) for every leaf that --leaf asks for: `leaf` asks for that one alone, and name()
/// turns a result's name into that leaf's: leaf.glb becomes leaf-2.glb with --leaf all; an empty name stays
/// empty.
void for_each_leaf(
    const LeafRequest& request,
    const std::function<void(const LeafRequest& leaf,
                             const std::function<std::string(const std::string&)>& name)>& run);

/// Adds --veins.
void add_veins_option(CLI::App& verb, LeafRequest& request);

/// The veins of the leaf: found, then replaced by those of the request's file, if there is one.
Venation load_veins(const LeafRequest& request, const Leaf& leaf, const SecondaryVeinRule& rule,
                    const VenationOptions& options, const Monitor& monitor);

/// Throws Error{input} for what is neither a species nor a file that can be read.
Leaf load_leaf(const LeafRequest& request, const Monitor& monitor);

/// Whether LEAF names one of the built-in species.
bool is_species(const std::string& leaf);

}  // namespace wilt::cli
