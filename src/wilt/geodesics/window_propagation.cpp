// Symbols, in the frame of halfedge h = (v1, v2) with the face that the window enters above:
//   I      image of the window's source, below the edge      sigma  its own distance (offset)
//   A, B   the window's ends on the edge                     v3     the third vertex of the face behind
#include "wilt/geodesics/window_propagation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wilt::detail {
namespace {

// A window must lose by this much of the distance before it is dropped: some roundings of a long path.
constexpr double kTie = 1e-13;
// A vertex so close to a window's end, in edge lengths, counts as seen: neighbouring windows that were cut at
// a vertex part by round-off further on.
constexpr double kSeen = 1e-10;
// Widens the wedge behind a vertex where paths bend, radians, against round-off in the angles.
constexpr double kWedge = 1e-11;
// Bucket width in mean edge lengths; affects speed only.
constexpr double kBucket = 0.5;

bool clearly_less(double a, double b) {
  return a < b * (1.0 - kTie);
}

double norm(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace

WindowPropagation::WindowPropagation(const SurfaceMesh& mesh, const Unfolding& unfolding, VertexId source,
                                     bool keep_history, std::span<const char> within)
    : mesh_(mesh),
      unfolding_(unfolding),
      source_(source),
      keep_history_(keep_history),
      within_(within),
      bucket_width_(kBucket * unfolding.mean_length()),
      distances_(mesh.num_vertices(), std::numeric_limits<double>::infinity()),
      swept_(mesh.num_vertices(), std::numeric_limits<double>::infinity()),
      arrivals_(mesh.num_vertices()),
      occupants_(3 * mesh.num_faces()) {}

void WindowPropagation::run(const std::vector<VertexId>& targets) {
  distances_[source_] = 0.0;
  bucket(0.0).vertices.push_back(source_);
  for (current_ = 0; current_ < buckets_.size(); ++current_) {
    const double reached = static_cast<double>(current_) * bucket_width_;
    if (!targets.empty() &&
        std::all_of(targets.begin(), targets.end(), [&](VertexId v) { return distances_[v] < reached; }))
      break;
    // Sweeping may add to this very bucket, and move the buckets: take everything by index.
    std::size_t vertex = 0, window = 0;
    while (true) {
      if (vertex < buckets_[current_].vertices.size()) {
        sweep_vertex(buckets_[current_].vertices[vertex++]);
      } else if (window < buckets_[current_].windows.size()) {
        const Window next = buckets_[current_].windows[window++];
        if (!is_useless(next)) sweep_window(next);
      } else {
        break;
      }
    }
    buckets_[current_] = Bucket();
  }
}

WindowPropagation::Bucket& WindowPropagation::bucket(double key) {
  const std::size_t index = std::max(current_, static_cast<std::size_t>(key / bucket_width_));
  if (index >= buckets_.size()) buckets_.resize(index + 1);
  return buckets_[index];
}

// Whether the window has a width, a source behind it and a face before it that may be entered.
bool WindowPropagation::leads_on(const Window& window) const {
  const HalfedgeId h = window.halfedge;
  return window.end > window.begin && window.source.y() < 0.0 &&
         (is_within(mesh_.from(h)) || is_within(mesh_.to(h)) || is_within(mesh_.to(mesh_.next(h))));
}

int WindowPropagation::record(const Window& window) {
  history_.push_back(window);
  return static_cast<int>(history_.size()) - 1;
}

void WindowPropagation::push(const Window& window) {
  const double nearest = std::clamp(window.source.x(), window.begin, window.end);
  bucket(window.offset + norm(nearest - window.source.x(), window.source.y())).windows.push_back(window);
}

void WindowPropagation::arrive(VertexId v, double distance, const Arrival& arrival) {
  distances_[v] = distance;
  arrivals_[v] = arrival;
  bucket(distance).vertices.push_back(v);
}

void WindowPropagation::sweep_vertex(VertexId v) {
  if (!(distances_[v] < swept_[v])) return;
  swept_[v] = distances_[v];
  mesh_.for_outgoing(v, [&](HalfedgeId h) {
    if (!is_within(mesh_.to(h))) return;
    const double distance = distances_[v] + unfolding_.length(h);
    if (clearly_less(distance, distances_[mesh_.to(h)])) arrive(mesh_.to(h), distance, {-1, h});
  });
  if (v == source_) return emit(v, 0.0, unfolding_.total_angle(v));
  if (!unfolding_.pseudo_source(v)) return;
  // A shortest path leaves at least pi of surface on either side of a vertex, or the margin.
  const double pi = std::numbers::pi, total = unfolding_.total_angle(v), in = arrival_angle(v);
  if (mesh_.is_boundary(v)) {
    emit(v, 0.0, in - pi + kWedge);
    emit(v, in + pi - kWedge, total);
  } else {
    const double first = in + pi - kWedge, last = in + total - pi + kWedge;
    emit(v, first, last);
    emit(v, first - total, last - total);
  }
}

double WindowPropagation::arrival_angle(VertexId v) const {
  const Arrival& arrival = arrivals_[v];
  if (arrival.edge.valid()) return unfolding_.angle(mesh_.twin(arrival.edge));
  const Window& window = history_[arrival.window];
  const HalfedgeId right = mesh_.next(window.halfedge);  // from its twin, clockwise, to the ray
  const HalfedgeFrame& frame = unfolding_.frame(window.halfedge);
  const Vec2 ray = window.source - frame.apex;
  const Vec2& axis = frame.right;
  const double turn = std::atan2(axis.y() * ray.x() - axis.x() * ray.y(), axis.dot(ray));
  return unfolding_.angle(mesh_.twin(right)) + turn;
}

void WindowPropagation::emit(VertexId v, double from_angle, double to_angle) {
  mesh_.for_outgoing(v, [&](HalfedgeId h) {
    const HalfedgeId in = mesh_.twin(h);
    if (mesh_.is_boundary(in)) return;
    const HalfedgeId across = mesh_.twin(mesh_.prev(in));
    if (mesh_.is_boundary(across)) return;
    const HalfedgeFrame& frame = unfolding_.frame(mesh_.twin(across));
    const Vec2 source(frame.length - frame.apex.x(), -frame.apex.y());
    const double start = unfolding_.angle(h);
    const Vec2 left = -source, right = Vec2(frame.length, 0.0) - source;
    const double corner = std::atan2(left.y() * right.x() - left.x() * right.y(), left.dot(right));
    if (from_angle >= start + corner || to_angle <= start) return;
    const auto at = [&](double turn) {
      const double c = std::cos(turn), s = std::sin(turn);
      const double x = left.x() * c + left.y() * s, y = left.y() * c - left.x() * s;
      return std::clamp(source.x() - source.y() * x / y, 0.0, frame.length);
    };
    const double begin = from_angle <= start ? 0.0 : at(from_angle - start);
    const double end = to_angle >= start + corner ? frame.length : at(to_angle - start);
    const Window window{begin, end, source, distances_[v], across, -1, false};
    if (leads_on(window)) push(window);
  });
}

// Xin and Wang's filter: a path through a vertex of the face behind is shorter for the whole window.
bool WindowPropagation::is_useless(const Window& window) const {
  const HalfedgeId h = window.halfedge, back = mesh_.twin(h);
  const double length = unfolding_.length(h);
  const Vec2& source = window.source;
  const double at_begin = window.offset + norm(window.begin - source.x(), source.y());
  if (clearly_less(distances_[mesh_.to(h)] + (length - window.begin), at_begin)) return true;
  const double at_end = window.offset + norm(window.end - source.x(), source.y());
  if (clearly_less(distances_[mesh_.from(h)] + window.end, at_end)) return true;
  const Vec2& apex = unfolding_.frame(back).apex;  // seen from the other side
  const double behind = distances_[mesh_.to(mesh_.next(back))];
  const double x = length - apex.x();
  if (window.from_start) return clearly_less(behind + norm(x - window.begin, apex.y()), at_begin);
  return clearly_less(behind + norm(x - window.end, apex.y()), at_end);
}

void WindowPropagation::sweep_window(const Window& window) {
  const HalfedgeFrame& frame = unfolding_.frame(window.halfedge);
  const Vec2& source = window.source;
  const double crossing = meet_axis(source, frame.apex);
  const double distance = window.offset + (frame.apex - source).norm();
  const double slack = kSeen * frame.length;
  const bool seen = window.begin - slack <= crossing && crossing <= window.end + slack;

  // The paths beyond the winner's path to the apex would have to cross it (Chen and Han).
  Occupant& occupant = occupants_[window.halfedge];
  double left_end = std::min(window.end, crossing), right_begin = std::max(window.begin, crossing);
  if (clearly_less(occupant.distance, distance)) {
    left_end = std::min(left_end, occupant.crossing);
    right_begin = std::max(right_begin, occupant.crossing);
    if (seen)
      (crossing < occupant.crossing ? right_begin : left_end) =
          crossing < occupant.crossing ? window.end : window.begin;
  } else if (seen && distance < occupant.distance) {
    occupant = {distance, std::clamp(crossing, window.begin, window.end)};
  }
  const VertexId apex = mesh_.to(mesh_.next(window.halfedge));
  const bool arrives = seen && clearly_less(distance, distances_[apex]);
  int recorded = -1;
  if (arrives) {
    recorded = record(window);
    arrive(apex, distance, {recorded, HalfedgeId()});
  }
  split(window, crossing, left_end, right_begin, recorded);
}

// Hands [begin, left_end] and [right_begin, end] on through the left and the right edge of the face.
// `recorded` is the window's place in the history, or -1.
void WindowPropagation::split(const Window& window, double crossing, double left_end, double right_begin,
                              int recorded) {
  const HalfedgeId h = window.halfedge;
  const HalfedgeFrame& frame = unfolding_.frame(h);
  const auto child = [&](HalfedgeId across, const Vec2& origin, const Vec2& axis, double begin, double end,
                         bool left) {
    if (mesh_.is_boundary(across) || !(end > begin)) return;
    const Vec2 source = into_frame(window.source, origin, axis);
    const double length = unfolding_.length(across);
    const auto at = [&](double x) {
      return std::clamp(meet_axis(source, into_frame({x, 0.0}, origin, axis)), 0.0, length);
    };
    const double from = !left && begin == crossing ? 0.0 : at(begin);
    const double to = left && end == crossing ? length : at(end);
    Window next{from, to, source, window.offset, across, 0, left};
    if (!leads_on(next)) return;
    if (keep_history_) next.parent = recorded = recorded < 0 ? record(window) : recorded;
    push(next);
  };
  child(mesh_.twin(mesh_.prev(h)), Vec2::Zero(), frame.left, window.begin, left_end, true);
  child(mesh_.twin(mesh_.next(h)), frame.apex, frame.right, right_begin, window.end, false);
}

}  // namespace wilt::detail
