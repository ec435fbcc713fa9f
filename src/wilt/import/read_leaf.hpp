// A user's file as a leaf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt {

struct ReadOptions {
  /// 200 to 1,000,000. Outlines are meshed with 2000, photos with 5000 unless this is given; a mesh keeps its
  /// own vertices unless this is given: then it is remeshed, texture coordinates carried over.
  std::optional<int> vertices;
  /// Where the stalk meets the blade; the nearest point of the margin is taken. For an outline x, y as drawn,
  /// for a photo pixels from its top left corner (inside the blade where basal lobes overlap: the blade is
  /// then cut open to there). For a mesh two of the file's coordinates: the axis nearest to the blade's
  /// normal is left out and the others keep their order, so x, z for a leaf that lies flat in a Y-up file, x,
  /// y for one that stands.
  std::optional<Vec2> petiole;
  int nth = 1;  ///< the N-th largest leaf of a photo or drawing or piece of a scan, from 1
  // Of photos only:
  std::optional<double> mm_per_pixel;  ///< > 0; absent: the leaf is taken to be 100 mm across
  std::filesystem::path mask;          ///< picture, white where leaves are; empty: from the photo itself
  /// Colour difference from the background (CIE Lab, lightness counting half) at which a leaf begins, above 0
  /// to 100; by itself from the photo's histogram.
  std::optional<double> threshold;
  std::uint64_t seed = 1;
  bool scan = false;  ///< take a mesh's vertices as the points of a scan
  /// The unit of a scan, > 0; absent: millimetres if the blade's box is 2 units across or more, else metres.
  std::optional<double> mm_per_unit;
};

/// The extensions that read_leaf knows, each with its dot, in lower case.
const std::vector<std::string>& leaf_file_extensions();

/// Reads a mesh (.obj .ply .stl .glb .gltf), an outline (.svg, .json), a photo (.jpg, .png; docs/photos.md)
/// or a scan (.xyz .txt .csv, a .ply without faces; docs/scans.md) into the leaf frame. What was found,
/// assumed or repaired is said in Leaf::notes. Mesh files are Y up: (X, Y, Z) becomes (X, -Z, Y); their unit
/// is the metre. Scans in text files are Z up. An SVG's unit is 1/96 inch unless its width and height are
/// physical lengths and it has a viewBox. Seam vertices of a mesh are joined in Leaf::mesh and kept in
/// Leaf::skin. Throws Error{input}, naming the file, when it cannot be used. Deterministic.
Leaf read_leaf(const std::filesystem::path& file, const ReadOptions& options = {},
               const Monitor& monitor = {});

/// How many leaves a photo shows, as `nth` counts them; 1 for every other file. Throws as read_leaf does.
int count_leaves(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace wilt
