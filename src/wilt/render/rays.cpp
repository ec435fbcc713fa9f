#include "wilt/render/rays.hpp"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

namespace wilt {
namespace {

// Area-weighted; a vertex without area gets the upward direction.
Points3 computed_normals(const Surface& surface) {
  Points3 normals = Points3::Zero(surface.positions.rows(), 3);
  for (int f = 0; f < surface.faces.rows(); ++f) {
    const auto corner = [&](int i) -> Vec3 { return surface.positions.row(surface.faces(f, i)).transpose(); };
    const Vec3 area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    for (int i = 0; i < 3; ++i) normals.row(surface.faces(f, i)) += area.transpose();
  }
  return normals;
}

void normalise_rows(Points3& normals) {
  for (int v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0.0) {
      normals.row(v) /= length;
    } else {
      normals.row(v) << 0.0, 0.0, 1.0;
    }
  }
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay r{};
  r.org_x = float(ray.origin.x()), r.org_y = float(ray.origin.y()), r.org_z = float(ray.origin.z());
  r.dir_x = float(ray.direction.x()), r.dir_y = float(ray.direction.y()), r.dir_z = float(ray.direction.z());
  r.tnear = 0.0f;
  r.tfar = std::numeric_limits<float>::infinity();
  r.mask = ~0u;
  return r;
}

}  // namespace

World::World(const Scene& scene)
    : scene_(scene), device_(rtcNewDevice(nullptr), rtcReleaseDevice), surfaces_(nullptr, rtcReleaseScene) {
  WILT_CHECK(device_ != nullptr, rtcGetDeviceError(nullptr));
  const Points3 points = scene_points(scene_);
  const Vec3 low = points.colwise().minCoeff().transpose(), high = points.colwise().maxCoeff().transpose();
  centre_ = 0.5 * (low + high);
  scale_ = std::max(0.5 * (high - low).norm(), std::numeric_limits<double>::min());
  add_surfaces();
}

void World::add_surfaces() {
  surfaces_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(surfaces_.get(), RTC_SCENE_FLAG_ROBUST);
  for (Surface& surface : scene_.surfaces) {
    if (surface.normals.rows() == 0) surface.normals = computed_normals(surface);
    normalise_rows(surface.normals);
    surface.positions.rowwise() -= centre_.transpose();
    surface.positions /= scale_;
    maps_.push_back({Texture(surface.colour_map, Texture::Kind::colour),
                     Texture(surface.normal_map, Texture::Kind::direction)});

    const Handle<RTCGeometryTy> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE),
                                         rtcReleaseGeometry);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                                 RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                                 surface.positions.rows()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                                                                   RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                                   surface.faces.rows()));
    WILT_CHECK(vertices != nullptr && indices != nullptr, rtcGetDeviceError(device_.get()));
    std::copy_n(surface.positions.data(), surface.positions.size(), vertices);
    std::copy_n(surface.faces.data(), surface.faces.size(), indices);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(surfaces_.get(), geometry.get());
  }
  rtcCommitScene(surfaces_.get());
}

std::optional<Hit> World::first_hit(const Ray& ray) const {
  RTCRayHit query{embree_ray(ray), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(surfaces_.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  Hit hit;
  hit.distance = query.ray.tfar;
  hit.surface = static_cast<int>(query.hit.geomID);
  hit.face = static_cast<int>(query.hit.primID);
  hit.weights = Vec3(1.0 - double(query.hit.u) - double(query.hit.v), query.hit.u, query.hit.v);
  // Embree 3 gives the normal (v1 - v0) x (v2 - v0), not of unit length.
  hit.geometric_normal = Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  return hit;
}

bool World::blocked(const Ray& ray) const {
  RTCRay query = embree_ray(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(surfaces_.get(), &context, &query);
  return query.tfar < 0.0f;
}

}  // namespace wilt
