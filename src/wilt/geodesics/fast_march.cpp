#include "wilt/geodesics/fast_march.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wilt::detail {
namespace {

// The root of vertices that are reached straight from a curve.
constexpr int kCurve = -2;
// A path along an edge that bends less than this at its vertex, radians, keeps its root: the gaps that
// curvature leaves between neighbouring faces are no shadows.
constexpr double kBend = 0.05;
// A ray may miss the edge by this much of its length; the error is of second order in the miss.
constexpr double kMiss = 1e-6;
// A front's curvature may differ from a flat surface's by this factor: more is noise of a rough surface.
constexpr double kFocus = 10.0;
// The largest squared distance of two neighbours' nearest points on one curve, in squared edge lengths.
constexpr double kPiece = 1.2;
// A finished vertex is opened again only when its distance falls below this much of it: beyond an obtuse
// corner the straight path may come later than one along an edge.
constexpr double kGain = 1.0 - 1e-9;

}  // namespace

FastMarch::FastMarch(const SurfaceMesh& mesh, const Unfolding& unfolding)
    : mesh_(mesh), unfolding_(unfolding), states_(mesh.num_vertices()) {}

void FastMarch::add_source(VertexId v) {
  State state;
  state.distance = 0.0;
  state.root = v;
  push(v, state);
}

void FastMarch::add_curve_point(VertexId v, double distance, double angle) {
  if (!(distance < states_[v].distance)) return;
  State state;
  state.distance = distance;
  state.angle = angle;
  state.root = kCurve;
  push(v, state);
}

void FastMarch::run() {
  const auto later = [](const Entry& a, const Entry& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.vertex > b.vertex;
  };
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const VertexId v = heap_.back().vertex;
    heap_.pop_back();
    State& state = states_[v];
    if (state.finished) continue;
    state.finished = true;
    if (state.halfedge.valid()) state.angle = arrival_angle(v);
    sweep(v);
  }
}

void FastMarch::push(VertexId v, const State& state) {
  states_[v] = state;
  heap_.push_back({state.distance, v});
  std::push_heap(heap_.begin(), heap_.end(), [](const Entry& a, const Entry& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.vertex > b.vertex;
  });
}

double FastMarch::arrival_angle(VertexId v) const {
  const State& state = states_[v];
  const HalfedgeFrame& frame = unfolding_.frame(state.halfedge);
  const Vec2 ray = state.image - frame.apex;
  const Vec2& axis = frame.right;
  const double turn = std::atan2(axis.y() * ray.x() - axis.x() * ray.y(), axis.dot(ray));
  return unfolding_.angle(mesh_.twin(mesh_.next(state.halfedge))) + turn;
}

void FastMarch::sweep(VertexId u) {
  mesh_.for_outgoing(u, [&](HalfedgeId h) {
    along_edge(h);
    if (mesh_.is_boundary(h)) return;
    // face(h) = (u, a, b): b across the edge u a, and a across the edge b u.
    across(h);
    across(mesh_.prev(h));
  });
}

// By how much the path to u and on along `out` bends at u, radians; 0 at a source.
double FastMarch::bend(VertexId u, HalfedgeId out) const {
  const State& state = states_[u];
  if (state.distance - state.offset <= kMiss * unfolding_.length(out)) return 0.0;
  double turn = std::abs(unfolding_.angle(out) - state.angle);
  if (!mesh_.is_boundary(u)) turn = std::min(turn, unfolding_.total_angle(u) - turn);
  return std::abs(std::numbers::pi - turn);
}

void FastMarch::along_edge(HalfedgeId h) {
  const VertexId u = mesh_.from(h), v = mesh_.to(h);
  const State& from = states_[u];
  const double distance = from.distance + unfolding_.length(h);
  if (!(distance < kGain * states_[v].distance)) return;
  State state;
  state.distance = distance;
  const bool straight = bend(u, h) < (mesh_.is_boundary(u) ? kMiss : kBend);
  state.root = straight ? from.root : int(u);
  state.offset = straight ? from.offset : from.distance;
  state.angle = unfolding_.angle(mesh_.twin(h));
  push(v, state);
}

// The vertex opposite h from the two vertices of h, of which one has just been finished.
void FastMarch::across(HalfedgeId h) {
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  const State &a = states_[u], &b = states_[w];
  if (!a.finished || !b.finished) return;
  if (a.root == kCurve && b.root == kCurve) return curve(h);
  if (a.root != b.root) return two_roots(h);
  const double length = unfolding_.length(h), gap = a.distance - b.distance;
  if (a.distance == a.offset) return through(h, Vec2(0.0, 0.0), a.distance, u);
  if (b.distance == b.offset) return through(h, Vec2(length, 0.0), b.distance, w);
  // The front's centre: it fits both distances, and its rays turn from one end to the other as much as the
  // directions do: slope_b - slope_a = (length^2 - gap^2) (1/ra + 1/rb) / (2 length), solved for ra.
  const double slope_a = -std::cos(a.angle - unfolding_.angle(h));
  const double slope_b = std::cos(unfolding_.angle(mesh_.twin(h)) - b.angle);
  const double flat = 1.0 / (a.distance - a.offset) + 1.0 / (b.distance - b.offset);
  const double curvatures = std::clamp(2.0 * length * (slope_b - slope_a) / (length * length - gap * gap),
                                       flat / kFocus, flat * kFocus);
  const double product = curvatures * gap;
  const double ra = (product + 2.0 + std::sqrt(product * product + 4.0)) / (2.0 * curvatures);
  const double x = 0.5 * length - gap * gap / (2.0 * length) + ra * gap / length;
  through(h, {x, -std::sqrt(std::max(0.0, (ra - x) * (ra + x)))}, a.distance - ra, u);
}

// Offers the vertex opposite h the straight path from `image`, itself at distance `offset`, if it crosses h;
// its root is that of `like`.
void FastMarch::through(HalfedgeId h, const Vec2& image, double offset, VertexId like) {
  const HalfedgeFrame& frame = unfolding_.frame(h);
  if (image.y() > 0.0) return;
  const double crossing = meet_axis(image, frame.apex), miss = kMiss * frame.length;
  if (!(crossing >= -miss && crossing <= frame.length + miss)) return;
  State state;
  state.distance = offset + (frame.apex - image).norm();
  const VertexId v = mesh_.to(mesh_.next(h));
  if (!(state.distance < kGain * states_[v].distance)) return;
  state.offset = states_[like].offset;
  state.root = states_[like].root;
  state.image = image;
  state.halfedge = h;
  push(v, state);
}

// The image of the root of from(h), below h.
Vec2 FastMarch::image_at_start(HalfedgeId h) const {
  const VertexId u = mesh_.from(h);
  const State& state = states_[u];
  double turn = state.angle - unfolding_.angle(h);
  if (turn < 0.0 && !mesh_.is_boundary(u)) turn += unfolding_.total_angle(u);
  const double r = state.distance - state.offset;
  return {r * std::cos(turn), -r * std::sin(turn)};
}

// The image of the root of to(h), below h.
Vec2 FastMarch::image_at_end(HalfedgeId h) const {
  const VertexId w = mesh_.to(h);
  const State& state = states_[w];
  double turn = unfolding_.angle(mesh_.twin(h)) - state.angle;
  if (turn < 0.0 && !mesh_.is_boundary(w)) turn += unfolding_.total_angle(w);
  const double r = state.distance - state.offset;
  return {unfolding_.length(h) - r * std::cos(turn), -r * std::sin(turn)};
}

void FastMarch::two_roots(HalfedgeId h) {
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  const Vec2 at_u = image_at_start(h), at_w = image_at_end(h);
  const Vec2& apex = unfolding_.frame(h).apex;
  const auto side = [](const Vec2& a, const Vec2& b, const Vec2& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  // Where a root would reach the other end sooner than its distance, that end lies in its shadow, and the
  // line through both images bounds the shadow. The start of h is on the left of a ray that crosses h
  // upwards.
  const double length = unfolding_.length(h);
  const double u_at_w = states_[u].offset + (at_u - Vec2(length, 0.0)).norm();
  const double w_at_u = states_[w].offset + at_w.norm();
  const bool sees_u = u_at_w >= states_[w].distance || side(at_u, at_w, apex) > 0.0;
  const bool sees_w = w_at_u >= states_[u].distance || side(at_w, at_u, apex) < 0.0;
  if (sees_u) through(h, at_u, states_[u].offset, u);
  if (sees_w) through(h, at_w, states_[w].offset, w);
}

// The nearest point of the straight piece of curve between the nearest points of both ends of h. These are no
// farther apart than the ends, unless they belong to two curves or to two sides of a bend.
void FastMarch::curve(HalfedgeId h) {
  const Vec2 a = image_at_start(h), b = image_at_end(h);
  const HalfedgeFrame& frame = unfolding_.frame(h);
  const double squared = (b - a).squaredNorm();
  if (squared > kPiece * frame.length * frame.length) {
    through(h, a, 0.0, mesh_.from(h));
    through(h, b, 0.0, mesh_.to(h));
    return;
  }
  const double t = squared > 0.0 ? std::clamp((frame.apex - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
  through(h, a + t * (b - a), 0.0, mesh_.from(h));
}

}  // namespace wilt::detail
