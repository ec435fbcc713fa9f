// What acts on the vertices: energies, and forces that have none.
#pragma once

#include <array>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/block_matrix.hpp"
#include "wilt/mechanics/spring_network.hpp"

namespace wilt {

/// Which second derivative goes into the matrix.
enum class Curvature {
  exact,         ///< the true (symmetric part of the) derivative, which may be indefinite
  semidefinite,  ///< a positive semi-definite stand-in, for when the exact one fails
};

/// A kind of element with its vertices: the part that energies and forces share.
class Term {
 public:
  virtual ~Term() = default;
  Term(const Term&) = delete;
  Term& operator=(const Term&) = delete;

  /// The vertices each element couples, #elements x k; empty when the term has no second derivative.
  const Stencil& stencil() const { return stencil_; }

  /// Looks up where the elements' blocks are; needed before a matrix of this pattern is filled.
  virtual void bind(const BlockPattern& pattern) { slots_ = pattern.pair_slots(stencil_); }

  /// Where the force is a law along edges (the rows of the stencil): adds a part of its coefficients and
  /// returns true.
  virtual bool add_edge_law(EdgeLaw&, EdgeLaw::Part) const { return false; }

  /// Whether the force depends neither on positions nor on velocities.
  virtual bool is_load() const { return false; }

  /// Grows whenever that part of its edge law changes.
  int revision(EdgeLaw::Part part) const { return revisions_[static_cast<int>(part)]; }

 protected:
  explicit Term(Stencil stencil = {}) : stencil_(std::move(stencil)) {}

  int element_count() const { return static_cast<int>(stencil_.rows()); }
  const int* vertices(int element) const { return stencil_.row(element).data(); }
  const int* slots(int element) const { return slots_.row(element).data(); }
  void changed(EdgeLaw::Part part) { ++revisions_[static_cast<int>(part)]; }

 private:
  Stencil stencil_, slots_;
  std::array<int, 2> revisions_{};
};

/// A conservative force: minus the gradient of energy(x), x #V x 3 in working lengths.
class Energy : public Term {
 public:
  virtual double energy(const Points3& x) const = 0;

  /// gradient += dE/dx, #V x 3.
  virtual void add_gradient(const Points3& x, Points3& gradient) const = 0;

  /// matrix += scale * d2E/dx2; scale >= 0.
  virtual void add_hessian(const Points3& x, BlockMatrix& matrix, double scale,
                           Curvature curvature) const = 0;

 protected:
  using Term::Term;
};

/// A force F(x, v) without an energy.
class Force : public Term {
 public:
  /// force += F, #V x 3.
  virtual void add_force(const Points3& x, const Points3& v, Points3& force) const = 0;

  /// matrix -= position_scale * sym(dF/dx) + velocity_scale * sym(dF/dv); scales >= 0.
  virtual void add_jacobian(const Points3& x, const Points3& v, BlockMatrix& matrix, double position_scale,
                            double velocity_scale, Curvature curvature) const = 0;

 protected:
  using Term::Term;
};

}  // namespace wilt
