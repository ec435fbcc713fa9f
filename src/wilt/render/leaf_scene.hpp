// The picture of a result: what a GLB of wilt holds, as a scene.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "wilt/output/gltf.hpp"
#include "wilt/render/scene.hpp"

namespace wilt {

/// A leaf on a table: how a GLB is shown, at any time of its clip.
///
/// The leaf is put down with the mean normal of its blade up and the way from its base to the middle of the
/// blade along +y, and tips until it rests (resting_pose.hpp); the table is at z = 0, the base above the
/// origin. The rests of neighbouring frames are blended, so that a clip does not jump. The mesh is refined
/// for a smooth outline, and a thin rim gives the blade its thickness. In the units of the file, Z up.
class LeafScene {
 public:
  /// Refers to `file`, which must outlive it. Throws Error{input} when a texture cannot be decoded. O(#frames
  /// #V).
  explicit LeafScene(const GlbFile& file);

  int frames() const { return static_cast<int>(turns_.size()); }

  /// The scene at `frame`, 0 to frames() - 1; between two frames everything is linear. `water` is w / m at
  /// that frame at the vertices of the file's blade (#S), for labels; or empty. Throws std::logic_error
  /// outside and for another number of vertices. O(#V).
  Scene at(double frame, const Eigen::VectorXd& water = {}) const;

 private:
  Surface surface(const GlbMesh& mesh, double frame) const;
  Surface rim(const Surface& blade) const;
  double relief(double frame) const;

  const GlbFile& file_;
  std::vector<Eigen::Quaterniond> turns_;  // from the file's axes to the table's, one per frame
  double length_ = 1.0;                    // of the blade at rest
  Image colour_map_, normal_map_;
};

/// LeafScene(file).at(frame).
Scene leaf_scene(const GlbFile& file, double frame);

}  // namespace wilt
