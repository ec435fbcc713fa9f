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

struct Cell {
  int x, y, z;
};

// Triangles by the cell of a grid in which the middle of their box lies. A cell is as large as the largest
// box, so what meets a triangle lies in its cell or in those around it. Cells next to each other along x
// stand next to each other in a table into which the whole grid is wrapped.
class CellGrid {
 public:
  explicit CellGrid(const std::vector<Box>& boxes) : cells_(boxes.size()), faces_(boxes.size()) {
    Box all;
    for (const Box& box : boxes) {
      all.extend(box);
      size_ = std::max(size_, box.sizes().maxCoeff());
    }
    size_ = size_ > 0.0 ? size_ * (1.0 + 1e-9) : 1.0;
    std::size_t slots = 64;
    while (slots < boxes.size()) slots *= 2;
    mask_ = slots - 1;
    starts_.assign(slots + 1, 0);
    for (std::size_t f = 0; f < boxes.size(); ++f) {
      const Eigen::Vector3i c =
          ((boxes[f].center() - all.min()) / size_).array().floor().cast<int>().matrix();
      cells_[f] = {c.x(), c.y(), c.z()};
      ++starts_[slot(cells_[f]) + 1];
    }
    for (std::size_t i = 0; i < slots; ++i) starts_[i + 1] += starts_[i];
    std::vector<int> filled(starts_.begin(), starts_.end() - 1);
    for (std::size_t f = 0; f < boxes.size(); ++f)
      faces_[static_cast<std::size_t>(filled[slot(cells_[f])]++)] = static_cast<int>(f);
  }

  /// Calls visit(g) for every triangle g > f in the cells in and around that of f.
  template <class Visit>
  void visit_near(int f, Visit&& visit) const {
    const Cell& cell = cells_[static_cast<std::size_t>(f)];
    for (int z = cell.z - 1; z <= cell.z + 1; ++z) {
      for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
          const std::size_t place = slot({x, y, z});
          for (int i = starts_[place]; i < starts_[place + 1]; ++i) {
            const int g = faces_[static_cast<std::size_t>(i)];
            const Cell& other = cells_[static_cast<std::size_t>(g)];
            if (g > f && other.x == x && other.y == y && other.z == z) visit(g);
          }
        }
      }
    }
  }

 private:
  std::size_t slot(const Cell& cell) const {
    return (static_cast<std::size_t>(cell.x) + static_cast<std::size_t>(cell.y) * 0x9e3779b1u +
            static_cast<std::size_t>(cell.z) * 0x85ebca77u) &
           mask_;
  }

  double size_ = 0.0;
  std::size_t mask_ = 0;
  std::vector<Cell> cells_;  // of each triangle
  std::vector<int> starts_;  // of each slot, in faces_
  std::vector<int> faces_;
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
    for (int f = begin; f < end; ++f) {
      const Box& box = boxes[static_cast<std::size_t>(f)];
      grid.visit_near(f, [&](int g) {
        if (!box.intersects(boxes[static_cast<std::size_t>(g)]) || share_a_vertex(faces, f, g)) return;
        if (triangles_intersect(triangle_of(faces, positions, f), triangle_of(faces, positions, g))) ++found;
      });
    }
    count += found;
  });
  return count;
}

}  // namespace wilt
