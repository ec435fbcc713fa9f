#include "wilt/import/surface_repair.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

#include "wilt/core/error.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::detail {
namespace {

// A triangle: its vertices (joined) and its corners in the soup.
struct Triangle {
  std::array<int, 3> v;
  std::array<int, 3> corner;
};
using Triangles = std::vector<Triangle>;

class UnionFind {
 public:
  explicit UnionFind(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);  // the smallest index stands for all
  }

 private:
  std::vector<int> parent_;
};

// For every soup vertex the first one at exactly the same place.
std::vector<int> join_exactly(const Points3& positions) {
  const int n = static_cast<int>(positions.rows());
  std::vector<int> order(n), first(n);
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) { return std::make_tuple(positions(v, 0), positions(v, 1), positions(v, 2)); };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (int i = 0; i < n; ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

double area(const Points3& positions, const std::array<int, 3>& v) {
  const Vec3 a = positions.row(v[0]), b = positions.row(v[1]), c = positions.row(v[2]);
  return (b - a).cross(c - a).norm() / 2;
}

struct Dropped {
  int degenerate = 0, repeated = 0;
};

Triangles clean_triangles(const TriangleSoup& soup, const std::vector<int>& joined, Dropped& dropped) {
  dropped = {};
  Triangles all;
  double total = 0.0;
  for (int f = 0; f < soup.faces.rows(); ++f) {
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      t.corner[k] = soup.faces(f, k);
      t.v[k] = joined[t.corner[k]];
    }
    total += area(soup.positions, t.v);
    all.push_back(t);
  }
  const double least = 1e-11 * total / static_cast<double>(all.size());
  std::vector<std::pair<std::array<int, 3>, int>> keys;
  for (std::size_t f = 0; f < all.size(); ++f) {
    std::array<int, 3> key = all[f].v;
    std::sort(key.begin(), key.end());
    keys.push_back({key, static_cast<int>(f)});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> keep(all.size(), 1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto& [key, f] = keys[i];
    if (key[0] == key[1] || key[1] == key[2] || !(area(soup.positions, all[f].v) > least)) {
      keep[f] = 0;
      ++dropped.degenerate;
    } else if (i > 0 && keys[i - 1].first == key) {
      keep[f] = 0;
      ++dropped.repeated;
    }
  }
  Triangles kept;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (keep[f]) kept.push_back(all[f]);
  }
  return kept;
}

// The edges of all faces, the faces of an edge one after another.
struct FaceEdge {
  int low, high, face, side;  // side k runs from v[k] to v[k+1]
};

std::vector<FaceEdge> sorted_edges(const Triangles& triangles) {
  std::vector<FaceEdge> edges;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangles[f].v[k], triangles[f].v[(k + 1) % 3]});
      edges.push_back({low, high, static_cast<int>(f), k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  return edges;
}

bool same_edge(const FaceEdge& a, const FaceEdge& b) {
  return a.low == b.low && a.high == b.high;
}

// The piece of every face: faces are connected through edges.
std::vector<int> pieces(const Triangles& triangles, const std::vector<FaceEdge>& edges, int& count) {
  UnionFind sets(static_cast<int>(triangles.size()));
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (same_edge(edges[i - 1], edges[i])) sets.join(edges[i - 1].face, edges[i].face);
  }
  std::vector<int> piece(triangles.size());
  count = 0;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const int root = sets.find(static_cast<int>(f));
    piece[f] = root == static_cast<int>(f) ? count++ : piece[root];
  }
  return piece;
}

// Joins border vertices that lie within `tolerance`; returns the joined vertex of every soup vertex.
std::vector<int> join_borders(const TriangleSoup& soup, const std::vector<int>& joined,
                              const std::vector<FaceEdge>& edges, double tolerance) {
  std::vector<int> border;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool shared = (i > 0 && same_edge(edges[i - 1], edges[i])) ||
                        (i + 1 < edges.size() && same_edge(edges[i], edges[i + 1]));
    if (!shared) border.insert(border.end(), {edges[i].low, edges[i].high});
  }
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  std::sort(border.begin(), border.end(), [&](int a, int b) {
    const double xa = soup.positions(a, 0), xb = soup.positions(b, 0);
    return xa != xb ? xa < xb : a < b;
  });
  UnionFind sets(static_cast<int>(joined.size()));
  for (std::size_t i = 0; i < border.size(); ++i) {
    for (std::size_t j = i + 1; j < border.size(); ++j) {
      if (soup.positions(border[j], 0) - soup.positions(border[i], 0) > tolerance) break;
      if ((soup.positions.row(border[i]) - soup.positions.row(border[j])).norm() <= tolerance)
        sets.join(border[i], border[j]);
    }
  }
  std::vector<int> result(joined.size());
  for (std::size_t v = 0; v < joined.size(); ++v) result[v] = sets.find(joined[v]);
  return result;
}

Triangles largest_piece(const TriangleSoup& soup, const Triangles& triangles, const std::vector<int>& piece,
                        int count, std::vector<std::string>& notes) {
  std::vector<double> areas(count, 0.0);
  for (std::size_t f = 0; f < triangles.size(); ++f) areas[piece[f]] += area(soup.positions, triangles[f].v);
  const int best = static_cast<int>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  Triangles kept;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (piece[f] == best) kept.push_back(triangles[f]);
  }
  if (count > 1) {
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    notes.push_back(
        fmt::format("the file holds {} separate pieces; the largest was taken ({} of {} faces, "
                    "{:.1f} % of the area) and the others left out",
                    count, kept.size(), triangles.size(), 100 * areas[best] / total));
  }
  return kept;
}

// Turns faces over until neighbours agree; fewer are turned than not.
void orient(Triangles& triangles, std::vector<std::string>& notes) {
  const std::vector<FaceEdge> edges = sorted_edges(triangles);
  const int n = static_cast<int>(triangles.size());
  std::vector<std::vector<std::pair<int, bool>>> neighbours(n);  // face, and whether they disagree
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const FaceEdge &a = edges[i - 1], &b = edges[i];
    if (!same_edge(a, b)) continue;
    const bool disagree = triangles[a.face].v[a.side] == triangles[b.face].v[b.side];
    neighbours[a.face].push_back({b.face, disagree});
    neighbours[b.face].push_back({a.face, disagree});
  }
  std::vector<int> turned(n, -1);
  std::vector<int> stack{0};
  turned[0] = 0;
  while (!stack.empty()) {
    const int f = stack.back();
    stack.pop_back();
    for (const auto& [g, disagree] : neighbours[f]) {
      const int wanted = turned[f] ^ static_cast<int>(disagree);
      if (turned[g] < 0) {
        turned[g] = wanted;
        stack.push_back(g);
      } else if (turned[g] != wanted) {
        throw Error(ErrorCode::input,
                    "the surface has one side only (like a Moebius strip), or edges with more than two "
                    "faces; cut it open so that it has an upper and a lower side");
      }
    }
  }
  int flips = static_cast<int>(std::count(turned.begin(), turned.end(), 1));
  if (flips == 0) return;
  const int over = 2 * flips > n ? 0 : 1;
  flips = std::min(flips, n - flips);
  for (int f = 0; f < n; ++f) {
    if (turned[f] != over) continue;
    std::swap(triangles[f].v[1], triangles[f].v[2]);
    std::swap(triangles[f].corner[1], triangles[f].corner[2]);
  }
  if (flips > 0) notes.push_back(fmt::format("{} of {} faces were turned over to face one way", flips, n));
}

// Corners that share an edge share a vertex; a vertex where several fans meet becomes several.
int split_fans(Triangles& triangles, std::vector<int>& source) {
  const int corners = 3 * static_cast<int>(triangles.size());
  UnionFind sets(corners);
  const std::vector<FaceEdge> edges = sorted_edges(triangles);
  const auto corner_of = [&](int face, int vertex) {
    const auto& v = triangles[face].v;
    return 3 * face + static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin());
  };
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (!same_edge(edges[i - 1], edges[i])) continue;
    for (const int v : {edges[i].low, edges[i].high})
      sets.join(corner_of(edges[i - 1].face, v), corner_of(edges[i].face, v));
  }
  std::map<std::pair<int, int>, int> ids;  // (old vertex, fan), so that the file's order is kept
  for (int c = 0; c < corners; ++c) ids.emplace(std::pair(triangles[c / 3].v[c % 3], sets.find(c)), 0);
  int next = 0;
  source.clear();
  int splits = 0;
  for (auto& [key, id] : ids) {
    splits += !source.empty() && source.back() == key.first;
    source.push_back(key.first);
    id = next++;
  }
  std::vector<std::array<int, 3>> fresh(triangles.size());
  for (int c = 0; c < corners; ++c) fresh[c / 3][c % 3] = ids.at({triangles[c / 3].v[c % 3], sets.find(c)});
  for (std::size_t f = 0; f < triangles.size(); ++f) triangles[f].v = fresh[f];
  return splits;
}

Skin make_skin(const TriangleSoup& soup, const Triangles& triangles) {
  Skin skin;
  std::map<std::tuple<int, double, double>, int> ids;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (!soup.uv.row(t.corner[k]).allFinite()) return {};
      ids.emplace(std::tuple(t.v[k], soup.uv(t.corner[k], 0), soup.uv(t.corner[k], 1)), 0);
    }
  }
  skin.uv.resize(static_cast<int>(ids.size()), 2);
  int next = 0;
  for (auto& [key, id] : ids) {
    id = next++;
    skin.vertex.push_back(VertexId(std::get<0>(key)));
    skin.uv.row(id) << std::get<1>(key), std::get<2>(key);
  }
  skin.faces.resize(static_cast<int>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int corner = triangles[f].corner[k];
      skin.faces(static_cast<int>(f), k) =
          ids.at({triangles[f].v[k], soup.uv(corner, 0), soup.uv(corner, 1)});
    }
  }
  return skin;
}

void check_finite(const TriangleSoup& soup) {
  for (int v = 0; v < soup.positions.rows(); ++v) {
    if (!soup.positions.row(v).allFinite())
      throw Error(
          ErrorCode::input,
          fmt::format("a vertex lies at ({}, {}, {}) (z up); positions must be finite numbers, in single "
                      "precision at most 3e38: mend or remove it",
                      soup.positions(v, 0), soup.positions(v, 1), soup.positions(v, 2)));
  }
}

}  // namespace

Sheet repair_surface(const TriangleSoup& soup, std::vector<std::string>& notes) {
  check_finite(soup);
  std::vector<int> joined = join_exactly(soup.positions);
  Dropped dropped;
  Triangles triangles = clean_triangles(soup, joined, dropped);
  int count = 0;
  std::vector<int> piece = pieces(triangles, sorted_edges(triangles), count);
  if (count > 1) {
    const Vec3 size = soup.positions.colwise().maxCoeff() - soup.positions.colwise().minCoeff();
    joined = join_borders(soup, joined, sorted_edges(triangles), 1e-5 * size.norm());
    Dropped dropped_joined;
    const Triangles together = clean_triangles(soup, joined, dropped_joined);
    int fewer = 0;
    const std::vector<int> piece_joined = pieces(together, sorted_edges(together), fewer);
    if (fewer < count) {
      notes.push_back(
          fmt::format("{} pieces whose borders lie within {:.2g} of each other were joined "
                      "(1e-5 of the file's size)",
                      count - fewer + 1, 1e-5 * size.norm()));
      triangles = together;
      piece = piece_joined;
      count = fewer;
      dropped = dropped_joined;
    }
  }
  if (triangles.empty())
    throw Error(ErrorCode::input, "every face of the file is without area; a leaf needs a surface");
  if (dropped.degenerate > 0)
    notes.push_back(fmt::format("{} faces without area were dropped", dropped.degenerate));
  if (dropped.repeated > 0) notes.push_back(fmt::format("{} repeated faces were dropped", dropped.repeated));

  triangles = largest_piece(soup, triangles, piece, count, notes);
  orient(triangles, notes);
  std::vector<int> source;
  if (const int splits = split_fans(triangles, source); splits > 0)
    notes.push_back(fmt::format("{} vertices where parts touched only in a point were split", splits));

  Faces faces(static_cast<int>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    faces.row(static_cast<int>(f)) << triangles[f].v[0], triangles[f].v[1], triangles[f].v[2];
  Sheet sheet;
  sheet.mesh = SurfaceMesh(static_cast<int>(source.size()), faces);
  sheet.positions.resize(static_cast<int>(source.size()), 3);
  for (std::size_t v = 0; v < source.size(); ++v)
    sheet.positions.row(static_cast<int>(v)) = soup.positions.row(source[v]);
  validate_blade(sheet.mesh, sheet.positions);
  sheet.skin = make_skin(soup, triangles);
  return sheet;
}

}  // namespace wilt::detail
