// Distance windows swept over a surface from one vertex. Internal to the room.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "wilt/geodesics/unfolding.hpp"

namespace wilt::detail {

/// A pencil of straight paths that enter face(halfedge) through [begin, end] of its edge.
struct Window {
  double begin, end;  ///< along the halfedge, 0 at from(h)
  Vec2 source;        ///< the image of the last vertex where the paths bent, in the halfedge's frame
  double offset;      ///< the distance up to that vertex
  HalfedgeId halfedge;
  int parent;       ///< in the history; -1: the paths start at the vertex behind the edge
  bool from_start;  ///< entered the face behind through the edge at from(h), not the one at to(h)
};

/// How the shortest path arrives at a vertex: in a window, or along an edge.
struct Arrival {
  int window = -1;  ///< in the history
  HalfedgeId edge;  ///< the last edge of the path; invalid at the source and for a window
};

/// Exact geodesic distances from one vertex: the windows of Mitchell, Mount and Papadimitriou (1987),
/// never trimmed against all others but pruned by "one angle, one split" (Chen and Han 1990), by the vertex
/// distances (Xin and Wang 2009), and taken in order of distance from buckets (Xu et al. 2015).
///
/// Pruning asks for a clear loss: in a tie both windows stay, which costs time and never a path.
class WindowPropagation {
 public:
  /// `within` (#V flags; empty: everywhere) must outlive it; windows enter faces that have a vertex there.
  WindowPropagation(const SurfaceMesh& mesh, const Unfolding& unfolding, VertexId source, bool keep_history,
                    std::span<const char> within = {});

  /// Sweeps the whole component of the source, or until the distance to every target is final.
  void run(const std::vector<VertexId>& targets = {});

  const std::vector<double>& distances() const { return distances_; }
  const std::vector<Window>& history() const { return history_; }
  const Arrival& arrival(VertexId v) const { return arrivals_[v]; }

 private:
  struct Bucket {
    std::vector<Window> windows;
    std::vector<VertexId> vertices;
  };
  // The winner of the windows that reach the vertex opposite a halfedge: where its path crosses, how long it
  // is.
  struct Occupant {
    double distance = std::numeric_limits<double>::infinity();
    double crossing = 0.0;
  };

  bool is_within(VertexId v) const { return within_.empty() || within_[v]; }
  Bucket& bucket(double key);
  bool leads_on(const Window& window) const;
  void push(const Window& window);
  int record(const Window& window);
  void arrive(VertexId v, double distance, const Arrival& arrival);
  void sweep_vertex(VertexId v);
  void emit(VertexId v, double from_angle, double to_angle);
  double arrival_angle(VertexId v) const;
  bool is_useless(const Window& window) const;
  void sweep_window(const Window& window);
  void split(const Window& window, double crossing, double left_end, double right_begin, int recorded);

  const SurfaceMesh& mesh_;
  const Unfolding& unfolding_;
  VertexId source_;
  bool keep_history_;
  std::span<const char> within_;
  double bucket_width_;
  std::size_t current_ = 0;
  std::vector<Bucket> buckets_;
  std::vector<double> distances_, swept_;  // swept_: the distance at which the vertex last sent windows
  std::vector<Arrival> arrivals_;
  std::vector<Occupant> occupants_;
  std::vector<Window> history_;
};

}  // namespace wilt::detail
