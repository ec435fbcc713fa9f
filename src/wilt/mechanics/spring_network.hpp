// All forces along the edges of a mesh in one pass.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "wilt/core/simd.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mechanics/edge_rows.hpp"

namespace wilt {

/// Forces along edges that act on vertex i as
///
///     F_i = sum_j (stretch - push_i / |x_ij|) x_ij + damping v_ij,   x_ij = x_j - x_i, v_ij = v_j - v_i.
///
/// A spring has stretch k and push k L; swelling is a push; damping is the paper's. Laws add up, and their
/// parts change apart: pushes in every step, stiffness seldom.
struct EdgeLaw {
  enum class Part { stiffness, push };

  Eigen::VectorXd stretch;               ///< #E, force per length; of the part stiffness
  Eigen::VectorXd damping;               ///< #E, force per velocity; of the part stiffness
  Eigen::MatrixX2d push;                 ///< #E x 2, force; column k acts on edges(e, k); of the part push
  std::array<int, 2> revisions{-1, -1};  ///< of both parts: another number, another part

  void set_zero(int edge_count, Part part) {
    if (part == Part::push) {
      push.setZero(edge_count, 2);
    } else {
      stretch.setZero(edge_count);
      damping.setZero(edge_count);
    }
  }
};

/// The sum of a law's forces over the edges at every vertex: each vertex gathers its neighbours, so the work
/// is twice that of a pass over edges, but nothing is scattered. Agrees with the sum over edges to round-off.
class SpringNetwork {
 public:
  /// `edges` #E x 2, indices in [0, vertex_count). The law is zero at first.
  SpringNetwork(int vertex_count, const Edges& edges);

  /// Takes over the parts of a law that it does not have yet. Throws Error{configuration} for a wrong count.
  void set_law(const EdgeLaw& law);

  /// force += F, #V x 3 each.
  void add_force(const Points3& x, const Points3& v, Points3& force) const;

  // For a solver that keeps its vectors in the rows' order.
  const detail::EdgeRows& rows() const { return rows_; }
  const Number8* stretch() const { return stretch_.data(); }  ///< per slot
  const Number8* push() const { return push_.data(); }        ///< per slot
  const Number8* damping() const { return damping_.data(); }  ///< per slot
  bool damped() const { return damped_; }
  int stiffness_revision() const { return revisions_[0]; }  ///< another one when that part changes

 private:
  void spread(const double* of_edge, int stride, std::vector<Number8>& slots) const;

  int edge_count_;
  detail::EdgeRows rows_;
  std::vector<Number8> stretch_, push_, damping_;
  bool damped_ = false;
  std::array<int, 2> revisions_{-1, -1};
};

}  // namespace wilt
