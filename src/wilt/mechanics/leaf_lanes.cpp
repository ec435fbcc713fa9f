#include "wilt/mechanics/leaf_lanes.hpp"

#include <algorithm>

namespace wilt::detail {

using simd::kLanes;

LeafSprings::LeafSprings(const EdgeRows& rows)
    : vertices_(rows.vertices.begin(), rows.vertices.begin() + rows.vertex_count()) {
  for (auto& revisions : revisions_) revisions.fill(-1);
  slot_begin_.push_back(0);
  for (int row = 0; row < rows.vertex_count(); ++row) {
    const int group = row / kLanes;
    for (int s = rows.group_begin[group]; s < rows.group_begin[group + 1]; ++s) {
      const int at = kLanes * s + row % kLanes;
      if (rows.ends[at] < 0) continue;
      neighbours_.push_back(rows.neighbours[at]);
      ends_.push_back(rows.ends[at]);
    }
    slot_begin_.push_back(static_cast<int>(ends_.size()));
  }
  stretch_.resize(ends_.size());
  push_.resize(ends_.size());
  damping_.resize(ends_.size());
}

void LeafSprings::set_laws(const std::array<const EdgeLaw*, LeafLanes::kLeaves>& laws) {
  for (const EdgeLaw::Part part : {EdgeLaw::Part::stiffness, EdgeLaw::Part::push}) {
    const int p = static_cast<int>(part);
    bool known = true;
    for (int l = 0; l < kLanes; ++l) known = known && revisions_[l][p] == laws[l]->revisions[p];
    if (!known) set_part(laws, part);
  }
  for (int l = 0; l < kLanes; ++l) revisions_[l] = laws[l]->revisions;
}

void LeafSprings::set_part(const std::array<const EdgeLaw*, LeafLanes::kLeaves>& laws, EdgeLaw::Part part) {
  const std::size_t slots = ends_.size();
  if (part == EdgeLaw::Part::push) {
    for (std::size_t s = 0; s < slots; ++s) {
      for (int l = 0; l < kLanes; ++l) push_[s].lanes[l] = laws[l]->push(ends_[s] / 2, ends_[s] % 2);
    }
    return;
  }
  for (std::size_t s = 0; s < slots; ++s) {
    for (int l = 0; l < kLanes; ++l) {
      stretch_[s].lanes[l] = laws[l]->stretch[ends_[s] / 2];
      damping_[s].lanes[l] = laws[l]->damping[ends_[s] / 2];
    }
  }
  damped_ = std::any_of(laws.begin(), laws.end(),
                        [](const EdgeLaw* law) { return (law->damping.array() != 0.0).any(); });
  ++stiffness_revision_;
}

}  // namespace wilt::detail
