// A maple leaf with its veins, and frames of a clip without a simulation.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "wilt/leaf/species.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt::bench {

/// 26 frames in which the blade arches and dries.
inline std::vector<Frame> arching_frames(const Leaf& leaf) {
  constexpr int kFrames = 26;
  const double length = leaf_length(leaf);
  std::vector<Frame> frames;
  for (int k = 0; k < kFrames; ++k) {
    const double t = static_cast<double>(k) / (kFrames - 1);
    Frame frame;
    frame.iteration = 4 * k;
    frame.positions = leaf.positions;
    frame.positions.col(2).array() += 0.3 * t * leaf.positions.col(0).array().square() / length;
    frame.stalk = leaf.stalk.centreline;
    frame.water_fraction = Eigen::VectorXd::Constant(leaf.positions.rows(), 0.8 - 0.3 * t);
    frame.dryness = Eigen::VectorXd::Constant(leaf.positions.rows(), t);
    frames.push_back(std::move(frame));
  }
  return frames;
}

struct Maple {
  Leaf leaf;
  Config config;
  Venation venation;
  std::vector<Frame> frames;

  Maple(int vertices, const std::string& model)
      : leaf(make_leaf("maple", vertices, 1)), config(default_config(species("maple"))) {
    config.model = model;
    venation = find_venation(leaf, species("maple").secondary, venation_options(config));
    frames = arching_frames(leaf);
  }
};

}  // namespace wilt::bench
