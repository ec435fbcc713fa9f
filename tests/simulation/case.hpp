// A leaf with its veins and a short run's configuration.
#pragma once

#include <string>

#include "wilt/leaf/species.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

struct Case {
  Leaf leaf;
  Config config;
  Venation venation;
};

/// Of a species, 20 iterations and 3 frames long.
inline Case make_case(const std::string& name, const std::string& model, int vertices = 400) {
  Case c{make_leaf(name, vertices, 1), default_config(species(name)), {}};
  c.config.model = model;
  c.config.iterations = 20;
  c.config.frames = 3;
  c.venation = find_venation(c.leaf, species(name).secondary, venation_options(c.config));
  return c;
}

}  // namespace wilt
