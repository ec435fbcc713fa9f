// Finding veins for Python.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "objects.hpp"

namespace wilt::python {

/// The veins of the leaf. Options are the settings veins.* without that word: veins(min_prominence=0.05).
/// file: a veins.json that `save` or `wilt veins` wrote for this leaf, edited; its veins stand for those
/// found. Raises ValueError, FileNotFoundError.
std::shared_ptr<VeinsObject> find_veins(const std::shared_ptr<const LeafObject>& leaf, const Config& config,
                                        const std::string& file);

/// A vein of a leaf.
struct VeinObject {
  std::shared_ptr<VeinsObject> veins;
  const Vein* vein;
};

/// #K x 3, metres, leaf frame, on the blade at rest: from the petiole (or the parent) outwards.
Points3 path_positions(const VeinObject& self);

/// Writes the veins as `wilt veins -o` does: .json, .svg or .obj. Raises ValueError for another name,
/// OSError.
void save_veins(const VeinsObject& veins, const std::filesystem::path& path);

}  // namespace wilt::python
