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

// Triangles by the cell of a grid in which the middle of their box lies. A cell is as large as the largest
// box, so what meets a triangle lies in its cell or in those around it. The rows of the grid (along x) share
// a table of fewer rows, next to each other there when they are next in y: what stands in a row of the table
// must be asked for its y and z.
class CellGrid {
 public:
  struct Entry {
    int face, x, y, z;
  };

  explicit CellGrid(const std::vector<Box>& boxes) : entries_(boxes.size()) {
    Box all;
    double size = 0.0;
    for (const Box& box : boxes) {
      all.extend(box);
      size = std::max(size, box.sizes().maxCoeff());
    }
    const double per_cell = size > 0.0 ? 1.0 / (size * (1.0 + 1e-9)) : 1.0;
    const int count = static_cast<int>(boxes.size());
    std::vector<Entry> by_face(boxes.size());
    parallel_for(count, 4096, [&](int begin, int end) {
      for (int f = begin; f < end; ++f) {
        const Vec3 place = (boxes[static_cast<std::size_t>(f)].center() - all.min()) * per_cell;
        by_face[static_cast<std::size_t>(f)] = {f, static_cast<int>(place.x()), static_cast<int>(place.y()),
                                                static_cast<int>(place.z())};
      }
    });
    stride_ = static_cast<std::size_t>(all.sizes().x() * per_cell) + 4;
    while ((mask_ + 1) * stride_ < boxes.size()) mask_ = 2 * mask_ + 1;
    starts_.assign((mask_ + 1) * stride_ + 1, 0);
    for (const Entry& entry : by_face) ++starts_[slot(entry) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    std::vector<int> filled = starts_;
    for (const Entry& entry : by_face) entries_[static_cast<std::size_t>(filled[slot(entry)]++)] = entry;
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// Calls visit(g) for triangles in the cells in and around that of entries()[i]; over all entries every
  /// pair of triangles is met once.
  template <class Visit>
  void visit_near(std::size_t i, Visit&& visit) const {
    const Entry& at = entries_[i];
    const auto visit_row = [&](int y, int z, int from_x, std::size_t after) {
      const std::size_t row = slot({0, 0, y, z}), end = static_cast<std::size_t>(starts_[row + at.x + 2]);
      for (std::size_t j = std::max(after, static_cast<std::size_t>(starts_[row + from_x])); j < end; ++j) {
        if (entries_[j].y == y && entries_[j].z == z) visit(entries_[j].face);
      }
    };
    visit_row(at.y, at.z, at.x, i + 1);
    visit_row(at.y + 1, at.z, at.x - 1, 0);
    for (int y = at.y - 1; y <= at.y + 1; ++y) visit_row(y, at.z + 1, at.x - 1, 0);
  }

 private:
  // One free slot before each row, for the cell at x = -1.
  std::size_t slot(const Entry& cell) const {
    constexpr int kApart = 977;  // rows between layers
    return 1 + static_cast<std::size_t>(cell.x) +
           (static_cast<std::size_t>(cell.y + kApart * cell.z) & mask_) * stride_;
  }

  std::size_t mask_ = 15, stride_ = 0;  // rows of the table less one, slots in each
  std::vector<int> starts_;             // of each slot, in entries_
  std::vector<Entry> entries_;
};

}  // namespace

int count_self_intersections(const Faces& faces, const Points3& positions) {
  if (!positions.allFinite()) return 0;
  const int face_count = static_cast<int>(faces.rows());
  std::vector<Box> boxes(static_cast<std::size_t>(face_count));
  parallel_for(face_count, 4096, [&](int begin, int end) {
    for (int f = begin; f < end; ++f)
      boxes[static_cast<std::size_t>(f)] = box_of(triangle_of(faces, positions, f));
  });
  const CellGrid grid(boxes);
  std::atomic<int> count{0};  // a sum of integers does not depend on the order
  parallel_for(face_count, 1024, [&](int begin, int end) {
    int found = 0;
    for (int i = begin; i < end; ++i) {
      const int f = grid.entries()[static_cast<std::size_t>(i)].face;
      const Box& box = boxes[static_cast<std::size_t>(f)];
      grid.visit_near(static_cast<std::size_t>(i), [&](int g) {
        if (!box.intersects(boxes[static_cast<std::size_t>(g)]) || share_a_vertex(faces, f, g)) return;
        if (triangles_intersect(triangle_of(faces, positions, f), triangle_of(faces, positions, g))) ++found;
      });
    }
    count += found;
  });
  return count;
}

}  // namespace wilt
