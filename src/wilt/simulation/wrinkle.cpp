// Symbols: the quadric z = c0 x^2 + c1 x y + c2 y^2 + c3 x + c4 y + c5 in the frame (u, w, n) of a vertex, n
// its normal and the vertex the origin, lengths in units of the radius; c5 is the height sought.
#include "wilt/simulation/wrinkle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "wilt/core/parallel.hpp"
#include "wilt/core/simd.hpp"

namespace wilt {
namespace {

constexpr double kRadius = 0.1;  // of L
constexpr int kMostVertices = 5000, kMostCentres = 4000, kMostAround = 150;
constexpr int kFewestAround = 9;

template <class T>
std::vector<T> thinned(const std::vector<T>& all, int most) {
  if (static_cast<int>(all.size()) <= most) return all;
  std::vector<T> some;
  for (int i = 0; i < most; ++i) some.push_back(all[static_cast<std::size_t>(i) * all.size() / most]);
  return some;
}

// Vertices that stand for all, and which of them are neighbours (numbers into vertices).
struct Sample {
  std::vector<VertexId> vertices;
  std::vector<std::vector<int>> neighbours;
};

// The number of the sample vertex that reaches each vertex over the fewest edges.
VertexData<int> nearest_of(const SurfaceMesh& mesh, const std::vector<VertexId>& sample) {
  VertexData<int> nearest(mesh.num_vertices(), -1);
  std::vector<VertexId> queue = sample;
  for (std::size_t i = 0; i < sample.size(); ++i) nearest[sample[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const VertexId v = queue[i];
    mesh.for_outgoing(v, [&](HalfedgeId h) {
      if (nearest[mesh.to(h)] >= 0) return;
      nearest[mesh.to(h)] = nearest[v];
      queue.push_back(mesh.to(h));
    });
  }
  return nearest;
}

Sample make_sample(const SurfaceMesh& mesh) {
  Sample sample;
  for (const VertexId v : mesh.vertices()) sample.vertices.push_back(v);
  sample.vertices = thinned(sample.vertices, kMostVertices);
  const VertexData<int> nearest = nearest_of(mesh, sample.vertices);
  std::vector<std::pair<int, int>> pairs;
  for (const EdgeId e : mesh.edges()) {
    const auto [from, to] = mesh.edge_vertices(e);
    const int a = nearest[from], b = nearest[to];
    if (a != b) pairs.insert(pairs.end(), {{a, b}, {b, a}});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  sample.neighbours.resize(sample.vertices.size());
  for (const auto& [a, b] : pairs) sample.neighbours[static_cast<std::size_t>(a)].push_back(b);
  return sample;
}

// Numbers of the sample's vertices at least two rings (of the mesh) from the boundary.
std::vector<int> deep_interior(const SurfaceMesh& mesh, const Sample& sample) {
  std::vector<int> deep;
  for (int i = 0; i < static_cast<int>(sample.vertices.size()); ++i) {
    bool near_boundary = false;
    const VertexId v = sample.vertices[static_cast<std::size_t>(i)];
    mesh.for_outgoing(v, [&](HalfedgeId h) { near_boundary |= mesh.is_boundary(mesh.to(h)); });
    if (!near_boundary && !mesh.is_boundary(v)) deep.push_back(i);
  }
  return deep;
}

// The vertices connected to a centre through vertices within `radius` of it at rest, without it. `mark` holds
// a number per sample vertex, none of them the centre's.
std::vector<int> neighbourhood(const Sample& sample, const Points3& rest, int centre, double radius,
                               std::vector<int>& mark) {
  const auto place = [&](int i) { return rest.row(sample.vertices[static_cast<std::size_t>(i)]); };
  std::vector<int> found{centre};
  mark[static_cast<std::size_t>(centre)] = centre;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const int next : sample.neighbours[static_cast<std::size_t>(found[i])]) {
      int& seen = mark[static_cast<std::size_t>(next)];
      if (seen == centre || (place(next) - place(centre)).squaredNorm() > radius * radius) continue;
      seen = centre;
      found.push_back(next);
    }
  }
  std::vector<int> around;
  for (std::size_t i = 1; i < found.size(); ++i)
    around.push_back(sample.vertices[static_cast<std::size_t>(found[i])]);
  return around;
}

Vec3 normal_at(const SurfaceMesh& mesh, const Points3& positions, VertexId v) {
  Vec3 sum = Vec3::Zero();
  const auto arm = [&](HalfedgeId h) -> Vec3 {
    return (positions.row(mesh.to(h)) - positions.row(v)).transpose();
  };
  mesh.for_outgoing(v, [&](HalfedgeId h) {
    if (!mesh.is_boundary(h)) sum += arm(h).cross(arm(mesh.twin(mesh.prev(h))));
  });
  const double length = sum.norm();
  return length > 0.0 ? Vec3(sum / length) : Vec3::UnitZ();
}

/// The origins and axes of eight vertices' frames.
struct Frames8 {
  Point8 origin, u, w, n;
};

Frames8 frames_at(const SurfaceMesh& mesh, const Points3& positions, const std::array<int, 8>& centres) {
  Frames8 frames;
  const auto set = [](Point8& points, int lane, const Vec3& p) {
    points.x[lane] = p.x(), points.y[lane] = p.y(), points.z[lane] = p.z();
  };
  for (int lane = 0; lane < simd::kLanes; ++lane) {
    const VertexId centre(centres[static_cast<std::size_t>(lane)]);
    const Vec3 n = normal_at(mesh, positions, centre), u = n.unitOrthogonal();
    set(frames.origin, lane, positions.row(centre).transpose());
    set(frames.u, lane, u);
    set(frames.w, lane, n.cross(u));
    set(frames.n, lane, n);
  }
  return frames;
}

// c5 of eight vertices, in units of 1 / per_unit. `counts` of the vertices around; `indices` of them, eight a
// step, the centre itself where there are no more: it adds to the count alone, which is known.
WILT_CLONES void heights_over_quadrics(const double* points, const int* indices, int steps, const Frames8& f,
                                       const Number8& counts, double per_unit, Number8& heights) {
  constexpr int kTerms = 6;
  Double8 gram[kTerms][kTerms + 1] = {};  // the upper triangle, then the right-hand side
  for (int k = 0; k < steps; ++k) {
    const Point8 p = simd::gather(points, indices + simd::kLanes * k);
    const Point8 r = per_unit * (p - f.origin);
    const Double8 x = dot(r, f.u), y = dot(r, f.w), z = dot(r, f.n);
    const Double8 basis[kTerms] = {x * x, x * y, y * y, x, y, Double8{} + 1.0};
    for (int i = 0; i < kTerms; ++i) {
      for (int j = i; j < kTerms; ++j) gram[i][j] += basis[i] * basis[j];
      gram[i][kTerms] += basis[i] * z;
    }
  }
  gram[kTerms - 1][kTerms - 1] = counts.lanes;
  // Elimination without pivots: the matrix is symmetric and positive definite.
  for (int k = 0; k + 1 < kTerms; ++k) {
    for (int i = k + 1; i < kTerms; ++i) {
      const Double8 factor = gram[k][i] / (gram[k][k] + 1e-300);
      for (int j = i; j <= kTerms; ++j) gram[i][j] -= factor * gram[k][j];
    }
  }
  heights.lanes = gram[kTerms - 1][kTerms] / (gram[kTerms - 1][kTerms - 1] + 1e-300);
}

}  // namespace

WrinkleMeter::WrinkleMeter(const SurfaceMesh& mesh, const Points3& rest, double length)
    : mesh_(mesh), length_(length) {
  const Sample sample = make_sample(mesh);
  const std::vector<int> centres = thinned(deep_interior(mesh, sample), kMostCentres);
  std::vector<Stencil> stencils(centres.size());
  parallel_for(static_cast<int>(centres.size()), 256, [&](int begin, int end) {
    std::vector<int> mark(sample.vertices.size(), -1);
    for (int i = begin; i < end; ++i) {
      const int centre = centres[static_cast<std::size_t>(i)];
      stencils[static_cast<std::size_t>(i)] = {
          sample.vertices[static_cast<std::size_t>(centre)],
          thinned(neighbourhood(sample, rest, centre, kRadius * length, mark), kMostAround)};
    }
  });
  stencils.erase(std::remove_if(stencils.begin(), stencils.end(),
                                [](const Stencil& s) { return s.around.size() < kFewestAround; }),
                 stencils.end());
  centre_count_ = static_cast<int>(stencils.size());
  pack(stencils);
}

void WrinkleMeter::pack(const std::vector<Stencil>& stencils) {
  constexpr std::size_t kLanes = simd::kLanes;
  for (std::size_t i = 0; i < stencils.size(); i += kLanes) {
    Group group{{}, {}, indices_.size(), 0};
    const auto stencil = [&](std::size_t lane) -> const Stencil& {
      return stencils[std::min(i + lane, stencils.size() - 1)];
    };
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      group.centres[lane] = stencil(lane).centre;
      group.counts[lane] = static_cast<int>(stencil(lane).around.size());
      group.steps = std::max(group.steps, group.counts[lane]);
    }
    for (int k = 0; k < group.steps; ++k) {
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        indices_.push_back(k < group.counts[lane] ? stencil(lane).around[static_cast<std::size_t>(k)]
                                                  : group.centres[lane]);
    }
    groups_.push_back(group);
  }
}

double WrinkleMeter::operator()(const Points3& positions) const {
  if (groups_.empty()) return 0.0;
  const double squares = parallel_sum(static_cast<int>(groups_.size()), 32, [&](int begin, int end) {
    double sum = 0.0;
    for (int i = begin; i < end; ++i) {
      const Group& group = groups_[static_cast<std::size_t>(i)];
      Number8 counts, heights;
      for (std::size_t lane = 0; lane < group.counts.size(); ++lane) counts.lanes[lane] = group.counts[lane];
      heights_over_quadrics(positions.data(), &indices_[group.first], group.steps,
                            frames_at(mesh_, positions, group.centres), counts, 1.0 / (kRadius * length_),
                            heights);
      for (int lane = 0; lane < std::min(simd::kLanes, centre_count_ - simd::kLanes * i); ++lane)
        sum += heights.lanes[lane] * heights.lanes[lane];
    }
    return sum;
  });
  return kRadius * std::sqrt(squares / centre_count_);
}

}  // namespace wilt
