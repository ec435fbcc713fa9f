// What each pixel of a picture shows: the truth that goes with a rendered leaf.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/render/camera.hpp"
#include "wilt/render/scene.hpp"
#include "wilt/render/vein_orders.hpp"

namespace wilt {

// With a result in hand (Leaf leaf; Clip clip; SimulationResult result; frame k):
//
//   const GlbFile file = parse_glb(glb_bytes(clip), "result");
//   const LeafScene shown(file);
//   const LeafLabels labels(file);                                 // once per leaf
//   const Scene scene = shown.at(k, skin_water(leaf, result.frames[k].water_fraction));
//   picture.camera = frame_camera(scene_points(scene), aspect, picture.view);
//   write_image(stem + ".png", render(scene, picture));
//   const LabelMaps maps = labels.maps(scene, *picture.camera, picture.width, picture.height);
//   write_label_maps(stem, maps, all_label_kinds());                // label_files.hpp
//   const std::string json = label_json(maps);

/// A point of the leaf in a picture.
struct Keypoint {
  double x = 0.0, y = 0.0;  ///< pixels from the top left corner; the middle of the first pixel is (0.5, 0.5)
  bool inside = false;      ///< of the picture
  bool visible = false;     ///< inside, and the leaf does not stand before it
};

/// Labels of a picture; rows from the top, one value per pixel: of what the ray through its middle meets.
///
/// A picture blends what lies within 3/4 of a pixel, so on edges it shows a mixture where labels decide.
struct LabelMaps {
  int width = 0, height = 0;       ///< pixels
  std::vector<std::uint8_t> part;  ///< Part; the ground is background
  std::vector<std::uint8_t> vein;  ///< order of the vein (1: primary), 0 beside veins and off the blade
  std::vector<float> water;        ///< w / m, 0 to 1; 0 off the blade, or when the scene has no water
  std::vector<float> depth;        ///< metres along the camera's axis; infinite for background
  /// Unit, towards the viewer; x right, y up, z out of the picture. The smooth surface without the fine
  /// relief of its normal map. 0 for background.
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals;

  std::array<int, 4> box{};          ///< left, top, width, height of the leaf (blade and stalk), 0 if unseen
  int area = 0;                      ///< pixels of the leaf
  std::vector<Keypoint> base, tips;  ///< where the blade begins (one or none); ends of the primary veins
  int apex = -1;                     ///< the tip that is farthest from the base at rest, or -1
  std::map<int, double> vein_width;  ///< metres, of each order, on the leaf at rest
  Camera camera;                     ///< its eye in metres
};

struct LabelOptions {
  /// Of primary veins, metres on the leaf at rest, 0 or more; 0: 0.008 times the root of the blade's area, as
  /// they look in a picture.
  double vein_width = 0.0;
  double vein_ratio = 0.55;  ///< width of an order relative to the one before, in (0, 1]
  void validate() const;     ///< throws Error{configuration}
};

/// The labels of one result. Refers to `file`, which must outlive it.
class LeafLabels {
 public:
  /// Throws Error{configuration} for options out of range, Error{input} for a file without its scale.
  explicit LeafLabels(const GlbFile& file, const LabelOptions& options = {});

  /// `scene` is LeafScene::at() of the file, `camera` and the size (1 to 16384) those of the picture.
  /// Deterministic on any number of threads. O(pixels log #F). Throws as render() does.
  LabelMaps maps(const Scene& scene, const Camera& camera, int width, int height,
                 const Monitor& monitor = {}) const;

 private:
  class Painter;
  void add_keypoints(const Painter& painter, const Scene& scene, LabelMaps& maps) const;

  const GlbFile& file_;
  double metres_;  // per unit of the file
  VeinOrders veins_;
};

/// Water fractions of the blade's vertices (#V) at those of its skin (#S), as LeafScene::at() takes them.
Eigen::VectorXd skin_water(const Leaf& leaf, const Eigen::VectorXd& water_fraction);

}  // namespace wilt
