#include "wilt/simulation/self_intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

using Triangle = std::array<Vec3, 3>;
using Box = Eigen::AlignedBox3d;

Triangle triangle_of(const Faces& faces, const Points3& positions, int f) {
  return {positions.row(faces(f, 0)).transpose(), positions.row(faces(f, 1)).transpose(),
          positions.row(faces(f, 2)).transpose()};
}

Box box_of(const Triangle& t) {
  Box box(t[0]);
  box.extend(t[1]);
  box.extend(t[2]);
  return box;
}

double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Whether segment pq passes through the triangle: its ends lie on both sides, its line within the three
// edges.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Triangle& t) {
  const double side_p = signed_volume(t[0], t[1], t[2], p), side_q = signed_volume(t[0], t[1], t[2], q);
  if ((side_p > 0.0) == (side_q > 0.0)) return false;
  const double u = signed_volume(p, q, t[0], t[1]);
  const double v = signed_volume(p, q, t[1], t[2]);
  const double w = signed_volume(p, q, t[2], t[0]);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  for (int k = 0; k < 3; ++k) {
    if (segment_meets_triangle(a[k], a[(k + 1) % 3], b) || segment_meets_triangle(b[k], b[(k + 1) % 3], a))
      return true;
  }
  return false;
}

bool share_a_vertex(const Faces& faces, int f, int g) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (faces(f, i) == faces(g, j)) return true;
    }
  }
  return false;
}

struct Entry {
  std::uint64_t cell;
  int face;
};

// Cells of a grid whose size is the largest triangle's box, so that a box lies in at most eight of them.
class CellGrid {
 public:
  explicit CellGrid(const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) {
      all.extend(box);
      size_ = std::max(size_, box.sizes().maxCoeff());
    }
    origin_ = all.min();
    if (!(size_ > 0.0)) size_ = 1.0;
    for (int f = 0; f < static_cast<int>(boxes.size()); ++f) {
      visit_cells(boxes[f], [&](std::uint64_t cell) { entries_.push_back({cell, f}); });
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.face < b.face;
    });
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// The one cell that reports a pair of overlapping boxes: that of the overlap's lower corner.
  std::uint64_t home_of(const Box& a, const Box& b) const { return key(cell_of(a.min().cwiseMax(b.min()))); }

 private:
  template <class Visit>
  void visit_cells(const Box& box, Visit&& visit) const {
    const Eigen::Vector3i low = cell_of(box.min()), high = cell_of(box.max());
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) visit(key({x, y, z}));
      }
    }
  }
  Eigen::Vector3i cell_of(const Vec3& p) const { return ((p - origin_) / size_).array().floor().cast<int>(); }
  static std::uint64_t key(const Eigen::Vector3i& c) {
    return static_cast<std::uint64_t>(c.x()) << 42 | static_cast<std::uint64_t>(c.y()) << 21 |
           static_cast<std::uint64_t>(c.z());
  }

  Vec3 origin_ = Vec3::Zero();
  double size_ = 0.0;
  std::vector<Entry> entries_;
};

}  // namespace

int count_self_intersections(const Faces& faces, const Points3& positions) {
  if (!positions.allFinite()) return 0;
  const int face_count = static_cast<int>(faces.rows());
  std::vector<Box> boxes(face_count);
  for (int f = 0; f < face_count; ++f) boxes[f] = box_of(triangle_of(faces, positions, f));
  const CellGrid grid(boxes);
  const std::vector<Entry>& entries = grid.entries();

  std::atomic<int> count{0};  // a sum of integers does not depend on the order
  parallel_for(static_cast<int>(entries.size()), 4096, [&](int begin, int end) {
    int found = 0;
    for (int i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j) {
        const int f = entries[i].face, g = entries[j].face;
        if (!boxes[f].intersects(boxes[g]) || grid.home_of(boxes[f], boxes[g]) != entries[i].cell) continue;
        if (share_a_vertex(faces, f, g)) continue;
        if (triangles_intersect(triangle_of(faces, positions, f), triangle_of(faces, positions, g))) ++found;
      }
    }
    count += found;
  });
  return count;
}

}  // namespace wilt
