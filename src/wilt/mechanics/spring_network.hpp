// All forces along the edges of a mesh in one pass.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/simd.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mechanics/edge_rows.hpp"

namespace wilt {

/// Forces along edges that act on vertex i as
///
///     F_i = sum_j (stretch - push_i / |x_ij|) x_ij + damping v_ij,   x_ij = x_j - x_i, v_ij = v_j - v_i.
///
/// A spring has stretch k and push k L; swelling is a push; damping is the paper's. Laws add up.
struct EdgeLaw {
  explicit EdgeLaw(int edge_count)
      : stretch(Eigen::VectorXd::Zero(edge_count)),
        push(Eigen::MatrixX2d::Zero(edge_count, 2)),
        damping(Eigen::VectorXd::Zero(edge_count)) {}

  Eigen::VectorXd stretch;  ///< #E, force per length
  Eigen::MatrixX2d push;    ///< #E x 2, force; column k acts on edges(e, k)
  Eigen::VectorXd damping;  ///< #E, force per velocity
};

/// The sum of a law's forces over the edges at every vertex: each vertex gathers its neighbours, so the work
/// is twice that of a pass over edges, but nothing is scattered. Agrees with the sum over edges to round-off.
class SpringNetwork {
 public:
  /// `edges` #E x 2, indices in [0, vertex_count). The law is zero at first.
  SpringNetwork(int vertex_count, const Edges& edges);

  /// Throws Error{configuration} for a wrong count.
  void set_law(const EdgeLaw& law);

  /// force += F, #V x 3 each.
  void add_force(const Points3& x, const Points3& v, Points3& force) const;

  // For a solver that keeps its vectors in the rows' order.
  const detail::EdgeRows& rows() const { return rows_; }
  const Number8* stretch() const { return stretch_.data(); }  ///< per slot
  const Number8* push() const { return push_.data(); }        ///< per slot
  const Number8* damping() const { return damping_.data(); }  ///< per slot
  bool damped() const { return damped_; }
  int stiffness_revision() const { return stiffness_revision_; }  ///< grows when stretch or damping changes

 private:
  void spread(const double* of_edge, int stride, std::vector<Number8>& slots) const;

  detail::EdgeRows rows_;
  EdgeLaw law_;
  std::vector<Number8> stretch_, push_, damping_;
  bool damped_ = false;
  int stiffness_revision_ = 0;
};

}  // namespace wilt
