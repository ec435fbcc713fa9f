#include "wilt/import/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "wilt/core/check.hpp"
#include "wilt/import/flatten.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {
namespace {

struct Hit {
  int face = -1;
  Vec3 weights = Vec3::Zero();  // barycentric, of the face's nearest point
  double distance = 1e300;
};

// The nearest point of a triangle in the plane.
Hit nearest_in(const Points2& flat, const Faces& faces, int f, const Vec2& p) {
  const Vec2 a = flat.row(faces(f, 0)), b = flat.row(faces(f, 1)), c = flat.row(faces(f, 2));
  const auto cross = [](const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double area = cross(b - a, c - a);
  const Vec3 w(cross(b - p, c - p) / area, cross(c - p, a - p) / area, cross(a - p, b - p) / area);
  if (w.minCoeff() >= 0) return {f, w, 0.0};
  Hit best;
  const std::array<Vec2, 3> corners{a, b, c};
  for (int k = 0; k < 3; ++k) {
    const Vec2 from = corners[k], along = corners[(k + 1) % 3] - from;
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (p - from - t * along).norm();
    if (distance >= best.distance) continue;
    best = {f, Vec3::Zero(), distance};
    best.weights[k] = 1 - t;
    best.weights[(k + 1) % 3] = t;
  }
  return best;
}

// Finds the face of a planar triangulation nearest to a point, among those of one chart if one is named.
class Locator {
 public:
  Locator(const Points2& flat, const Faces& faces, const std::vector<int>& chart)
      : flat_(flat), faces_(faces), chart_(chart), low_(flat.colwise().minCoeff().transpose()) {
    const Vec2 size = flat.colwise().maxCoeff().transpose() - low_;
    cell_ = std::sqrt(size.x() * size.y() / std::max<double>(1.0, static_cast<double>(faces.rows())));
    columns_ = static_cast<int>(size.x() / cell_) + 1;
    rows_ = static_cast<int>(size.y() / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int f = 0; f < faces.rows(); ++f) {
      Vec2 from = flat.row(faces(f, 0)), to = from;
      for (int k = 1; k < 3; ++k) {
        from = from.cwiseMin(flat.row(faces(f, k)).transpose());
        to = to.cwiseMax(flat.row(faces(f, k)).transpose());
      }
      const std::array<int, 2> first = cell_of(from), last = cell_of(to);
      for (int j = first[1]; j <= last[1]; ++j) {
        for (int i = first[0]; i <= last[0]; ++i) cells_[index(i, j)].push_back(f);
      }
    }
  }

  Hit nearest(const Vec2& p, int chart = -1) const {
    const auto [ci, cj] = cell_of(p);
    const double outside = (p - clamped(p)).norm();  // how far the point lies from the grid
    Hit best;
    for (int ring = 0; ring <= std::max(columns_, rows_); ++ring) {
      for (int j = cj - ring; j <= cj + ring; ++j) {
        const bool edge_row = j == cj - ring || j == cj + ring;
        for (int i = ci - ring; i <= ci + ring; i += edge_row || ring == 0 ? 1 : 2 * ring)
          visit(i, j, p, chart, best);
      }
      if (best.face >= 0 && best.distance <= ring * cell_ - outside) break;
      if (best.face >= 0 && best.distance == 0.0) break;
    }
    WILT_CHECK(best.face >= 0, p.transpose(), chart);
    return best;
  }

 private:
  Vec2 clamped(const Vec2& p) const {
    return p.cwiseMax(low_).cwiseMin(low_ + cell_ * Vec2(columns_, rows_));
  }
  std::array<int, 2> cell_of(const Vec2& p) const {
    const Vec2 q = (clamped(p) - low_) / cell_;
    return {std::clamp(static_cast<int>(q.x()), 0, columns_ - 1),
            std::clamp(static_cast<int>(q.y()), 0, rows_ - 1)};
  }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * columns_ + i; }
  void visit(int i, int j, const Vec2& p, int chart, Hit& best) const {
    if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return;
    for (const int f : cells_[index(i, j)]) {
      if (chart >= 0 && chart_[f] != chart) continue;
      const Hit hit = nearest_in(flat_, faces_, f, p);
      if (hit.distance < best.distance) best = hit;
    }
  }

  const Points2& flat_;
  const Faces& faces_;
  const std::vector<int>& chart_;
  Vec2 low_;
  double cell_ = 1.0;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
};

// The chart of every face: faces are of one chart when they share skin vertices.
std::vector<int> charts(const Skin& skin) {
  std::vector<int> parent(skin.vertex.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto find = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (int f = 0; f < skin.faces.rows(); ++f) {
    for (int k = 1; k < 3; ++k) {
      const int a = find(skin.faces(f, 0)), b = find(skin.faces(f, k));
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<int> chart(skin.faces.rows());
  for (int f = 0; f < skin.faces.rows(); ++f) chart[f] = find(skin.faces(f, 0));
  return chart;
}

Skin carry_skin(const Skin& old, const std::vector<int>& chart, const Locator& locator,
                const PlanarMesh& planar) {
  Skin skin;
  std::map<std::pair<int, int>, int> ids;  // (vertex, chart)
  std::vector<Vec2> uv;
  skin.faces.resize(planar.mesh.num_faces(), 3);
  for (const FaceId f : planar.mesh.faces()) {
    const auto v = planar.mesh.face_vertices(f);
    const Vec2 centroid =
        (planar.positions.row(v[0]) + planar.positions.row(v[1]) + planar.positions.row(v[2])).transpose() /
        3;
    const int own = chart[locator.nearest(centroid).face];
    for (int k = 0; k < 3; ++k) {
      const auto [it, fresh] = ids.emplace(std::pair<int, int>(v[k], own), static_cast<int>(uv.size()));
      if (fresh) {
        const Hit hit = locator.nearest(planar.positions.row(v[k]).transpose(), own);
        Vec2 at = Vec2::Zero();
        for (int j = 0; j < 3; ++j) at += hit.weights[j] * old.uv.row(old.faces(hit.face, j)).transpose();
        uv.push_back(at);
        skin.vertex.push_back(v[k]);
      }
      skin.faces(int(f), k) = it->second;
    }
  }
  skin.uv.resize(static_cast<int>(uv.size()), 2);
  for (std::size_t i = 0; i < uv.size(); ++i) skin.uv.row(static_cast<int>(i)) = uv[i].transpose();
  return skin;
}

}  // namespace

Remeshed remesh(const Sheet& sheet, VertexId petiole, int vertices, const Monitor& monitor) {
  const Points2 flat = flatten_sheet(sheet.mesh, sheet.positions);
  MeshingOptions options;
  options.vertices = vertices;
  options.keep = {flat.row(petiole).transpose()};
  PlanarMesh planar = mesh_outline(boundary_outline(sheet.mesh, sheet.positions, flat), options, monitor);

  const Faces& faces = sheet.mesh.face_matrix();
  const bool textured = !sheet.skin.vertex.empty();
  const std::vector<int> chart = textured ? charts(sheet.skin) : std::vector<int>();
  const Locator locator(flat, faces, chart);
  Remeshed result;
  result.petiole = planar.kept.front();
  result.sheet.positions.resize(planar.positions.rows(), 3);
  for (const VertexId v : planar.mesh.vertices()) {
    const Hit hit = locator.nearest(planar.positions.row(v).transpose());
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < 3; ++k) at += hit.weights[k] * sheet.positions.row(faces(hit.face, k)).transpose();
    result.sheet.positions.row(v) = at.transpose();
  }
  if (textured) result.sheet.skin = carry_skin(sheet.skin, chart, locator, planar);
  result.sheet.mesh = std::move(planar.mesh);
  return result;
}

}  // namespace wilt::detail
