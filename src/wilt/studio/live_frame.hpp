// A leaf as a page draws it: single precision, one entry per point of the skin.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "wilt/studio/session.hpp"

namespace wilt {

/// What does not change while the leaf withers. Points are vertices of the leaf's skin.
struct LiveLeaf {
  std::vector<std::uint32_t> vertex;         ///< #S, of the mesh
  std::vector<std::uint32_t> faces;          ///< #F x 3 points
  std::vector<float> uv;                     ///< #S x 2, origin top left
  std::uint32_t stalk_points = 0;            ///< of LiveFrame::stalk_positions
  std::vector<std::uint32_t> stalk_faces;    ///< of LiveFrame::stalk_positions
  std::vector<std::uint32_t> tip_points;     ///< #tips
  std::vector<std::uint32_t> margin_points;  ///< #M, as MarginProfile has them
  std::vector<std::uint32_t> vein_start;     ///< #veins + 1: where each begins among LiveFrame::veins
  std::vector<std::uint8_t> vein_order;      ///< #veins
  std::uint32_t petiole_point = 0;
};

/// The leaf after an iteration. Metres, the leaf frame with Y up: (x, y, z) becomes (x, z, -y).
struct LiveFrame {
  /// What can be shown on the blade; working units, forces as magnitudes.
  static constexpr std::array<const char*, 9> kFields = {
      "mass", "water", "water_fraction", "dryness", "pressure", "elastic", "damping", "swelling", "external"};
  std::vector<float> positions, normals;                  ///< #S x 3
  std::vector<float> colours;                             ///< #S x 3, linear, times the session's texture
  std::vector<float> stalk_positions, stalk_normals;      ///< of a tube
  std::array<float, 3> stalk_colour{};                    ///< linear
  std::vector<float> veins;                               ///< three per point of the veins
  std::array<std::vector<float>, kFields.size()> fields;  ///< #S each
  std::vector<float> tip_forces;                          ///< #tips x 3, Y up
  double water_left = 1.0;                                ///< of the leaf, share of what it began with
};

LiveLeaf live_leaf(const StudioSession& session);
LiveFrame live_frame(const StudioSession& session);

}  // namespace wilt
