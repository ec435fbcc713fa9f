#include "wilt/run/withered_leaf.hpp"

#include <fmt/format.h>

#include <chrono>

#include "wilt/leaf/species.hpp"

namespace wilt {

WitheredLeaf prepare(const LeafRequest& request, const Config& config, const Monitor& monitor) {
  WitheredLeaf prepared;
  prepared.config = config;
  const auto start = std::chrono::steady_clock::now();
  prepared.leaf = load_leaf(request, monitor);
  prepared.timings.leaf = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  prepared.venation = load_veins(request, prepared.leaf, species(config.species).secondary,
                                 venation_options(config), monitor);
  prepared.timings.geodesics = prepared.venation.timings.geodesics;
  prepared.timings.embedding = prepared.venation.timings.embedding;
  prepared.timings.venation = prepared.venation.timings.venation;
  monitor.say(fmt::format("{}: {} vertices, {:.0f} mm, {} vein tip{}", prepared.leaf.name,
                          prepared.leaf.mesh.num_vertices(), 1e3 * leaf_length(prepared.leaf),
                          prepared.venation.tips.size(), prepared.venation.tips.size() == 1 ? "" : "s"));
  return prepared;
}

std::string report_of(const WitheredLeaf& withered) {
  return report_json(withered.leaf, withered.venation, withered.result, to_json(withered.config),
                     withered.timings);
}

}  // namespace wilt
