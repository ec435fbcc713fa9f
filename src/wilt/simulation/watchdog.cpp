#include "wilt/simulation/watchdog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/simulation/model_parts.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

constexpr int kBlock = 16384;  // edges

// dt x the velocities' root mean square over the mass, less their mean, in leaf lengths.
double relative_motion(double kinetic, const Points3& v, const Eigen::VectorXd& masses, double dt) {
  const double mass = masses.sum();
  const double mean = (v.transpose() * masses).squaredNorm() / (mass * mass);
  return dt * std::sqrt(std::max(0.0, 2.0 * kinetic / mass - mean)) / kWorkingLength;
}

}  // namespace

Watchdog::Watchdog(const SurfaceMesh& mesh, const Points3& rest, double dt, double tolerance)
    : edges_(mesh.edge_matrix()), rest_lengths_(rest_lengths(mesh, rest)), dt_(dt), tolerance_(tolerance) {}

double Watchdog::largest_stretch(const Points3& x) const {
  const auto count = static_cast<int>(edges_.rows());
  std::vector<double> squares((count + kBlock - 1) / kBlock);
  parallel_for(static_cast<int>(squares.size()), 1, [&](int begin, int end) {
    for (int block = begin; block < end; ++block) {
      double largest = 0.0;
      for (int e = block * kBlock; e < std::min(count, (block + 1) * kBlock); ++e) {
        const double square = (x.row(edges_(e, 1)) - x.row(edges_(e, 0))).squaredNorm();
        largest = std::max(largest, square / (rest_lengths_[e] * rest_lengths_[e]));
      }
      squares[block] = largest;
    }
  });
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

std::string Watchdog::complaint(const StepRow& row, const Points3& x, const Points3& v,
                                const Eigen::VectorXd& masses) const {
  for (const auto& [name, value] : {std::pair("kinetic energy", row.kinetic),
                                    {"elastic energy", row.elastic},
                                    {"bending energy", row.bending},
                                    {"water", row.water}}) {
    if (!(value >= 0.0) || !std::isfinite(value))
      return fmt::format("the {} of the leaf is {}; take a smaller dt or weaker forces", name, value);
  }
  if (!(row.residual <= tolerance_ * (1.0 + 1e-9)))  // round-off of the quotient
    return fmt::format("a residual of {:.3g} passed for converged; solver.tolerance is {:.3g}", row.residual,
                       tolerance_);
  if (const double stretch = largest_stretch(x); !(stretch <= kLargestStretch))
    return fmt::format(
        "an edge has {:.3g} times its rest length, more than {:g}; no leaf stretches so: weaken "
        "swelling and external forces or stiffen the springs",
        stretch, kLargestStretch);
  if (const double motion = relative_motion(row.kinetic, v, masses, dt_); !(motion <= kLargestMotion))
    return fmt::format(
        "the leaf moves by {:.3g} of its length in one step, more than {:g}; take a smaller dt or "
        "weaker forces",
        motion, kLargestMotion);
  return {};
}

}  // namespace wilt
