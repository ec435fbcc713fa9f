// The scene as rays see it: nearest hits, shadows, and the nearest vein, by Embree 3.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/render/scene.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace wilt {

struct Ray {
  Vec3 origin, direction;  ///< of unit length
};

struct Hit {
  double distance = 0.0;
  int surface = -1, face = -1;
  Vec3 weights;           ///< barycentric, of the face's corners
  Vec3 geometric_normal;  ///< of unit length, of the upper side
};

struct VeinHit {
  double distance = 0.0;  ///< to the vein's centre line
  double radius = 0.0;    ///< of the vein there
  Vec3 away;              ///< unit vector from the centre line to the point
  int vein = -1;
};

/// A copy of a scene in units of its radius about its centre, so that every tolerance is a plain number.
class World {
 public:
  explicit World(const Scene& scene);

  const Scene& scene() const { return scene_; }  ///< in world units, normals complete and of unit length
  double scale() const { return scale_; }        ///< metres in a world unit
  Vec3 to_world(const Vec3& metres) const { return (metres - centre_) / scale_; }

  std::optional<Hit> first_hit(const Ray& ray) const;
  bool blocked(const Ray& ray) const;
  /// The vein whose ridge is highest at a point, if one is within `reach` of its radii.
  std::optional<VeinHit> nearest_vein(const Vec3& point, double reach) const;

 private:
  struct Segment {
    Vec3 a, b;
    double radius_a, radius_b;
    int vein;
  };
  template <class T>
  using Handle = std::unique_ptr<T, void (*)(T*)>;

  void add_surfaces();
  void add_veins();

  Scene scene_;
  Vec3 centre_;
  double scale_ = 1.0;
  std::vector<Segment> segments_;
  double largest_radius_ = 0.0;
  Handle<RTCDeviceTy> device_;
  Handle<RTCSceneTy> surfaces_, veins_;

  friend struct VeinSearch;
};

}  // namespace wilt
