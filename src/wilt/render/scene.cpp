#include "wilt/render/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"
#include "wilt/core/stack_rows.hpp"

namespace wilt {
namespace {

void check_finish(const Finish& finish, const std::string& name) {
  const auto require = [&](bool ok, const char* key, double value, const char* allowed) {
    if (!ok)
      throw Error(ErrorCode::input, fmt::format("{}: {} is {}; allowed: {}", name, key, value, allowed));
  };
  const auto share = [](double v) { return v >= 0.0 && v <= 1.0; };
  require(share(finish.translucency), "translucency", finish.translucency, "0 to 1");
  require(share(finish.gloss), "gloss", finish.gloss, "0 to 1");
  require(finish.roughness >= 0.05 && finish.roughness <= 1.0, "roughness", finish.roughness, "0.05 to 1");
  require(finish.relief >= 0.0 && finish.relief <= 4.0, "relief", finish.relief, "0 to 4");
}

void check_map(const Image& map, const Surface& surface, const std::string& name) {
  if (map.rgb.empty()) return;
  const auto bytes = 3 * std::size_t(std::max(map.width, 0)) * std::size_t(std::max(map.height, 0));
  if (map.rgb.size() != bytes)
    throw Error(ErrorCode::input, fmt::format("{}: {} x {} pixels with {} bytes; 3 for each pixel are needed",
                                              name, map.width, map.height, map.rgb.size()));
  if (surface.uv.rows() == 0)
    throw Error(ErrorCode::input, name + ": the surface has no texture coordinates to place it by");
}

void check_surface(const Surface& surface, const std::string& name) {
  const auto fail = [&](const std::string& what) { throw Error(ErrorCode::input, name + ": " + what); };
  const auto vertices = surface.positions.rows();
  const auto rows = [&](Eigen::Index n, const char* what) {
    if (n != vertices) fail(fmt::format("{} {} for {} vertices; one for each is needed", n, what, vertices));
  };
  rows(surface.colours.rows(), "colours");
  if (surface.normals.rows() > 0) rows(surface.normals.rows(), "normals");
  if (surface.uv.rows() > 0) rows(surface.uv.rows(), "texture coordinates");
  if (surface.rest.rows() > 0) rows(surface.rest.rows(), "positions at rest");
  if (surface.water.size() > 0) rows(surface.water.size(), "water fractions");
  if (!surface.positions.allFinite()) fail("a position is not finite");
  if (!surface.normals.allFinite()) fail("a normal is not finite");
  if (!surface.uv.allFinite()) fail("a texture coordinate is not finite");
  if (!(surface.colours.array() >= 0.0).all() || !(surface.colours.array() <= 1.0).all())
    fail("a colour is outside 0 to 1 (linear RGB)");
  for (int f = 0; f < surface.faces.rows(); ++f)
    for (int i = 0; i < 3; ++i)
      if (surface.faces(f, i) < 0 || surface.faces(f, i) >= vertices)
        fail(fmt::format("face {} names vertex {}; there are {}", f, surface.faces(f, i), vertices));
  check_finish(surface.finish, name);
  check_map(surface.colour_map, surface, name + ", colour map");
  check_map(surface.normal_map, surface, name + ", normal map");
}

}  // namespace

Vec3 Sky::radiance(const Vec3& unit_direction) const {
  const double z = unit_direction.z();
  return horizon + std::abs(z) * ((z > 0.0 ? zenith : nadir) - horizon);
}

// (1 / pi) times the integral over the hemisphere of (h + (q - h) cos) cos.
Vec3 Sky::mean_above() const {
  return horizon + (zenith - horizon) * (2.0 / 3.0);
}

Vec3 sun_direction(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

Points3 scene_points(const Scene& scene) {
  std::vector<Points3> parts;
  for (const Surface& surface : scene.surfaces) parts.push_back(surface.positions);
  return stack_rows(parts);
}

void validate(const Scene& scene) {
  Eigen::Index faces = 0;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    check_surface(scene.surfaces[i], fmt::format("surface {}", i));
    faces += scene.surfaces[i].faces.rows();
  }
  if (faces == 0)
    throw Error(ErrorCode::input, "the scene is empty: no surface has a face; there is nothing to draw");
}

}  // namespace wilt
