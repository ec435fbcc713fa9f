// The scene as rays see it: nearest hits and shadows, by Embree 3.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/render/scene.hpp"
#include "wilt/render/texture.hpp"

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

/// The maps of a surface; empty ones are never asked.
struct Maps {
  Texture colour, normal;
};

/// A copy of a scene in units of its radius about its centre, so that every tolerance is a plain number.
class World {
 public:
  explicit World(const Scene& scene);

  const Scene& scene() const { return scene_; }  ///< in world units, normals complete and of unit length
  double scale() const { return scale_; }        ///< metres in a world unit
  Vec3 to_world(const Vec3& metres) const { return (metres - centre_) / scale_; }

  const Maps& maps(int surface) const { return maps_[std::size_t(surface)]; }

  std::optional<Hit> first_hit(const Ray& ray) const;
  bool blocked(const Ray& ray) const;

 private:
  template <class T>
  using Handle = std::unique_ptr<T, void (*)(T*)>;

  void add_surfaces();

  Scene scene_;
  Vec3 centre_;
  double scale_ = 1.0;
  std::vector<Maps> maps_;
  Handle<RTCDeviceTy> device_;
  Handle<RTCSceneTy> surfaces_;
};

}  // namespace wilt
