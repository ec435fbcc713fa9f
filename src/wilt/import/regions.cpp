#include "wilt/import/regions.hpp"

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>

namespace wilt::detail {
namespace {

namespace bp = boost::polygon;
using Point = bp::point_data<int>;
using Polygon = bp::polygon_with_holes_data<int>;
using Set = bp::polygon_set_data<int>;

double ring_area(const Points2& ring) {
  double twice = 0.0;
  for (int i = 0, n = static_cast<int>(ring.rows()); i < n; ++i) {
    const int j = (i + 1) % n;
    twice += ring(i, 0) * ring(j, 1) - ring(i, 1) * ring(j, 0);
  }
  return twice / 2;
}

struct Grid {
  Vec2 centre;
  double scale;

  Point to(const Vec2& p) const {
    const Vec2 q = (p - centre) * scale;
    return Point(static_cast<int>(std::lround(q.x())), static_cast<int>(std::lround(q.y())));
  }
  template <class Ring>
  Points2 from(const Ring& ring) const {
    std::vector<Vec2> points;
    for (const Point& p : ring) points.push_back(centre + Vec2(p.x(), p.y()) / scale);
    if (points.size() > 1 && points.front() == points.back()) points.pop_back();
    Points2 result(static_cast<int>(points.size()), 2);
    for (std::size_t i = 0; i < points.size(); ++i) result.row(static_cast<int>(i)) = points[i].transpose();
    return result;
  }
  std::vector<Outline> outlines(const Set& set) const {
    std::vector<Polygon> polygons;
    set.get(polygons);
    std::vector<Outline> result;
    for (const Polygon& polygon : polygons) {
      Outline outline;
      outline.margin = from(polygon);
      for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
        outline.holes.push_back(from(*hole));
      if (ring_area(outline.margin) < 0) outline.margin = outline.margin.colwise().reverse().eval();
      const double least = 1e-9 * std::pow(double(1 << 26) / scale, 2);
      outline.holes.erase(std::remove_if(outline.holes.begin(), outline.holes.end(),
                                         [&](const Points2& h) { return std::abs(ring_area(h)) < least; }),
                          outline.holes.end());
      if (outline.margin.rows() >= 3 && area_of(outline) >= least) result.push_back(std::move(outline));
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Outline& a, const Outline& b) { return area_of(a) > area_of(b); });
    return result;
  }
  Set set_of(const Outline& outline) const {
    Set set;
    const auto polygon_of = [&](const Points2& ring) {
      std::vector<Point> points;
      for (int i = 0; i < ring.rows(); ++i) points.push_back(to(ring.row(i).transpose()));
      return bp::polygon_data<int>(points.begin(), points.end());
    };
    set.insert(polygon_of(outline.margin));
    for (const Points2& hole : outline.holes) set.insert(polygon_of(hole), true);
    return set;
  }
};

// Rings with their own direction: what they wind around more often forwards than backwards.
Set positive_winding(const Grid& grid, const std::vector<svg::Ring>& rings, bool reversed) {
  Set set;
  for (const svg::Ring& ring : rings) {
    std::vector<Point> points;
    for (const Vec2& p : ring) points.push_back(grid.to(p));
    if (reversed) std::reverse(points.begin(), points.end());
    points.push_back(points.front());
    set.insert_vertex_sequence(points.begin(), points.end(), bp::COUNTERCLOCKWISE, false);
  }
  set.clean();
  return set;
}

}  // namespace

double area_of(const Outline& outline) {
  double area = std::abs(ring_area(outline.margin));
  for (const Points2& hole : outline.holes) area -= std::abs(ring_area(hole));
  return area;
}

RegionGrid::RegionGrid(const Vec2& low, const Vec2& high)
    : centre_((low + high) / 2), scale_((1 << 26) / std::max((high - low).maxCoeff(), 1e-300)) {}

std::vector<Outline> RegionGrid::fill(const std::vector<svg::Ring>& rings, bool even_odd) const {
  using namespace bp::operators;
  const Grid grid{centre_, scale_};
  const auto non_zero = [&](const std::vector<svg::Ring>& some) {
    Set set = positive_winding(grid, some, false);
    set |= positive_winding(grid, some, true);
    return set;
  };
  if (!even_odd) return grid.outlines(non_zero(rings));
  Set set;
  for (const svg::Ring& ring : rings) set ^= non_zero({ring});
  return grid.outlines(set);
}

std::vector<Outline> RegionGrid::unite(const Outline& a, const Outline& b) const {
  using namespace bp::operators;
  const Grid grid{centre_, scale_};
  Set set = grid.set_of(a);
  set |= grid.set_of(b);
  return grid.outlines(set);
}

double RegionGrid::overlap(const Outline& a, const Outline& b) const {
  using namespace bp::operators;
  const Grid grid{centre_, scale_};
  Set set = grid.set_of(a);
  set &= grid.set_of(b);
  return static_cast<double>(bp::area(set)) / (scale_ * scale_);
}

}  // namespace wilt::detail
