// Which leaf a run is to have: a species or a file, and how to read it.
#pragma once

#include <string>

#include "wilt/core/monitor.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

inline constexpr int kDefaultVertices = 2000;  ///< of a species

struct LeafRequest {
  std::string leaf;  ///< a species' name or a file
  /// Of a species: its vertices, seed and petiole only, the latter in millimetres in its leaf frame
  /// (leaf.hpp).
  ReadOptions read{};
  std::string veins;  ///< a veins.json to take the veins from, or empty: they are found
};

/// Whether `leaf` names one of the built-in species.
bool is_species(const std::string& leaf);

/// Gives the leaf the seed and, unless it is 0, the number of vertices of a configuration.
void take_size_and_seed(LeafRequest& request, const Config& config);

/// Makes or reads the leaf. Throws Error{input} for what is neither a species nor a file that can be read,
/// Error{configuration} for options of files with a species.
Leaf load_leaf(const LeafRequest& request, const Monitor& monitor = {});

/// The veins of the leaf: found, then replaced by those of the request's file, if there is one. Throws
/// Error{input}, naming the file, when its veins do not fit.
Venation load_veins(const LeafRequest& request, const Leaf& leaf, const SecondaryVeinRule& rule,
                    const VenationOptions& options, const Monitor& monitor = {});

}  // namespace wilt
