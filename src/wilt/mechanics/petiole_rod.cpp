// Symbols, counted from the clamp: d_j the vector of segment j at rest, R_j its rotation, R_m that of the
// blade end, Q_j the natural rotation at joint j, phi_j = log(Q_j^T R_{j-1}^T R_j) its bend, k_j its
// stiffness, F_j the weight that segment j carries. Rotations vary as R_j <- exp(delta_j) R_j; torque balance
// at j:
//     k_j R_j phi_j - k_{j+1} R_{j+1} phi_{j+1} - (R_j d_j) x F_j = 0.
// The moment m at the end enters by the potential -m . log(R_m): exactly m where the bending is planar.
#include "wilt/mechanics/petiole_rod.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

using Eigen::Matrix3d;

constexpr int kMaxIterations = 300;
constexpr double kTolerance = 1e-10;  // of the torques, relative to the loads'
constexpr double kRoundOff = 1e-14;   // of the torques, relative to the stiffest joint
constexpr double kLargestTurn = 0.5;  // radians, of any segment in one iteration

Matrix3d rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                     : Matrix3d(Matrix3d::Identity());
}

Vec3 log_of(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// The transposed inverse of d log(exp(delta) R) / d delta at delta = 0, applied to m.
Vec3 moment_torque(const Vec3& turn, const Vec3& moment) {
  const double angle = turn.norm();
  const double half = 0.5 * angle;
  const double beta = angle < 1e-3 ? 1.0 / 12.0 : (1.0 - half / std::tan(half)) / (angle * angle);
  return moment + 0.5 * turn.cross(moment) + beta * turn.cross(turn.cross(moment));
}

// The chain with its loads, ready to be balanced.
struct Chain {
  std::vector<Vec3> arms;      // d_j, and the arm of the end's force
  std::vector<Vec3> carried;   // F_j, and the end's force
  std::vector<double> joints;  // k_j, j = 0 .. m
  Vec3 moment;
  const std::vector<Matrix3d>& natural;

  int size() const { return static_cast<int>(joints.size()); }

  Vec3 bend(const std::vector<Matrix3d>& r, int j) const {
    return log_of(natural[j].transpose() * (j == 0 ? r[0] : Matrix3d(r[j - 1].transpose() * r[j])));
  }

  double energy(const std::vector<Matrix3d>& r) const {
    double sum = -moment.dot(log_of(r.back()));
    for (int j = 0; j < size(); ++j)
      sum += 0.5 * joints[j] * bend(r, j).squaredNorm() - carried[j].dot(r[j] * arms[j]);
    return sum;
  }

  std::vector<Vec3> torques(const std::vector<Matrix3d>& r) const {
    std::vector<Vec3> torque(joints.size());
    for (int j = 0; j < size(); ++j) {
      const Vec3 spring = joints[j] * (r[j] * bend(r, j));
      torque[j] = spring - (r[j] * arms[j]).cross(carried[j]);
      if (j > 0) torque[j - 1] -= spring;
    }
    torque.back() -= moment_torque(log_of(r.back()), moment);
    return torque;
  }

  // -H^-1 torque for the block-tridiagonal H (springs as at small bends, loads' geometry symmetrised) +
  // shift; false when that is not positive definite.
  bool newton_step(const std::vector<Matrix3d>& r, const std::vector<Vec3>& torque, double shift,
                   std::vector<Vec3>& step) const {
    std::vector<Eigen::LLT<Matrix3d>> pivots;
    step = torque;
    for (int j = 0; j < size(); ++j) {
      const Vec3 arm = r[j] * arms[j];
      const double k = joints[j], next = j + 1 < size() ? joints[j + 1] : 0.0;
      const Matrix3d outer = 0.5 * (arm * carried[j].transpose() + carried[j] * arm.transpose());
      Matrix3d block = (k + next + shift + arm.dot(carried[j])) * Matrix3d::Identity() - outer;
      if (j > 0) {
        block -= k * k * pivots.back().solve(Matrix3d::Identity());
        step[j] += k * pivots.back().solve(step[j - 1]);
      }
      pivots.emplace_back(block);
      if (pivots.back().info() != Eigen::Success) return false;
    }
    for (int j = size() - 1; j >= 0; --j) {
      if (j + 1 < size()) step[j] += joints[j + 1] * step[j + 1];
      step[j] = pivots[j].solve(step[j]);
    }
    for (Vec3& turn : step) turn = -turn;
    return true;
  }

  // Torque with which the unbent chain compares: that of the loads, and of the natural bends.
  double torque_scale() const {
    double length = 0.0, scale = moment.norm();
    for (int j = 0; j < size(); ++j) {
      length += arms[j].norm();
      scale = std::max(scale, joints[j] * log_of(natural[j]).norm());
    }
    for (const Vec3& force : carried) scale = std::max(scale, force.norm() * length);
    return scale;
  }
};

double largest(const std::vector<Vec3>& values) {
  double most = 0.0;
  for (const Vec3& value : values) most = std::max(most, value.norm());
  return most;
}

Chain make_chain(const Points3& centreline, const Eigen::VectorXd& masses, const RodLoads& loads,
                 const Eigen::VectorXd& stiffness, const std::vector<Matrix3d>& natural) {
  detail::require_count("bending stiffnesses", stiffness.size(), masses.size());
  detail::require_values("the bending stiffness of segment", stiffness, 0.0, true);
  for (const Vec3* load : {&loads.gravity, &loads.force, &loads.arm, &loads.moment})
    detail::require_finite("the rod's load, component", *load);
  const int m = static_cast<int>(masses.size());
  Chain chain{std::vector<Vec3>(m + 1), std::vector<Vec3>(m + 1), std::vector<double>(m + 1), loads.moment,
              natural};
  chain.arms[m] = loads.arm;
  chain.carried[m] = loads.force;
  Vec3 beyond = loads.force;
  for (int j = m - 1; j >= 0; --j) {
    const int given = m - 1 - j;  // the segment's number counted from the blade
    chain.arms[j] = (centreline.row(given) - centreline.row(given + 1)).transpose();
    const Vec3 weight = masses[given] * loads.gravity;
    chain.carried[j] = beyond + 0.5 * weight;
    beyond += weight;
  }
  const auto half = [&](int j) { return 0.5 * chain.arms[j].norm() / stiffness[m - 1 - j]; };
  for (int j = 0; j <= m; ++j)
    chain.joints[j] = 1.0 / ((j > 0 ? half(j - 1) : 0.0) + (j < m ? half(j) : 0.0));
  return chain;
}

// One step downhill along `step`, shortened until the energy falls. False at round-off.
bool descend(const Chain& chain, const std::vector<Vec3>& step, std::vector<Matrix3d>& r,
             std::vector<Vec3>& torque) {
  double slope = 0.0;
  for (int j = 0; j < chain.size(); ++j) slope += torque[j].dot(step[j]);
  const double before = chain.energy(r), torque_before = largest(torque);
  double length = std::min(1.0, kLargestTurn / std::max(largest(step), 1e-300));
  for (int k = 0; k < 40; ++k, length *= 0.5) {
    std::vector<Matrix3d> trial = r;
    for (int j = 0; j < chain.size(); ++j) trial[j] = rotation_of(length * step[j]) * r[j];
    std::vector<Vec3> trial_torque = chain.torques(trial);
    const double change = chain.energy(trial) - before;
    const bool below_round_off = std::abs(change) <= 1e-13 * (std::abs(before) + std::abs(slope));
    if (change <= 1e-4 * length * slope || (below_round_off && largest(trial_torque) < 0.9 * torque_before)) {
      r = std::move(trial);
      torque = std::move(trial_torque);
      return true;
    }
  }
  return false;
}

}  // namespace

PetioleRod::PetioleRod(const Points3& centreline, const Eigen::VectorXd& masses)
    : centreline_(centreline), masses_(masses) {
  if (centreline.rows() < 2)
    throw Error(ErrorCode::input,
                fmt::format("the stalk has {} points; a rod needs at least 2", centreline.rows()));
  detail::require_count("segment masses", masses.size(), centreline.rows() - 1);
  detail::require_values("the mass of segment", masses, 0.0, false);
  for (int s = 0; s < masses.size(); ++s) {
    const double length = (centreline.row(s + 1) - centreline.row(s)).norm();
    if (!(length > 0.0) || !std::isfinite(length))
      throw Error(ErrorCode::input,
                  fmt::format("segment {} of the stalk is {} long; remove repeated points", s, length));
  }
  natural_.assign(masses.size() + 1, Matrix3d::Identity());
  rotations_ = natural_;
}

void PetioleRod::balance(const RodLoads& loads, const Eigen::VectorXd& stiffness) {
  const std::vector<Matrix3d> straight(natural_.size(), Matrix3d::Identity());
  const Chain chain = make_chain(centreline_, masses_, loads, stiffness, straight);
  rotations_ = straight;
  // At R = I the springs must hold what the loads turn with beyond each joint.
  const std::vector<Vec3> torque = chain.torques(rotations_);
  Vec3 held = Vec3::Zero();
  for (int j = chain.size() - 1; j >= 0; --j) {
    held -= torque[j];
    natural_[j] = rotation_of(-held / chain.joints[j]);
  }
}

RodEquilibrium PetioleRod::solve(const RodLoads& loads, const Eigen::VectorXd& stiffness) {
  const Chain chain = make_chain(centreline_, masses_, loads, stiffness, natural_);
  const double stiffest = *std::max_element(chain.joints.begin(), chain.joints.end());
  const double scale = chain.torque_scale();
  const double target = kTolerance * scale + kRoundOff * stiffest;

  RodEquilibrium result;
  std::vector<Vec3> torque = chain.torques(rotations_), step;
  bool moving = true;
  while (largest(torque) > target && moving && result.iterations < kMaxIterations) {
    double shift = 0.0;
    while (!chain.newton_step(rotations_, torque, shift, step))
      shift = std::max(4.0 * shift, 1e-3 * stiffest);
    moving = descend(chain, step, rotations_, torque);
    ++result.iterations;
  }
  result.converged = largest(torque) <= target;
  result.residual = largest(torque) / (scale > 0.0 ? scale : stiffest);
  result.rotation = rotations_.back();
  const int m = chain.size() - 1;
  result.centreline = centreline_;
  for (int j = 0; j < m; ++j)
    result.centreline.row(m - 1 - j) =
        result.centreline.row(m - j) + (rotations_[j] * chain.arms[j]).transpose();
  return result;
}

Eigen::MatrixXd PetioleRod::rotations() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(rotations_.size()), 9);
  for (Eigen::Index j = 0; j < rows.rows(); ++j)
    rows.row(j) = Eigen::Map<const Eigen::RowVectorXd>(rotations_[static_cast<std::size_t>(j)].data(), 9);
  return rows;
}

void PetioleRod::set_rotations(const Eigen::MatrixXd& rotations) {
  detail::require_count("rotations", rotations.rows(), static_cast<Eigen::Index>(rotations_.size()));
  for (Eigen::Index j = 0; j < rotations.rows(); ++j)
    rotations_[static_cast<std::size_t>(j)] = Eigen::RowVectorXd(rotations.row(j)).reshaped(3, 3);
}

Eigen::VectorXd round_bending_stiffness(const Eigen::VectorXd& radii, double youngs_modulus) {
  Eigen::VectorXd stiffness(radii.size() - 1);
  for (int s = 0; s < stiffness.size(); ++s)
    stiffness[s] = youngs_modulus * std::numbers::pi / 4.0 * std::pow(0.5 * (radii[s] + radii[s + 1]), 4);
  return stiffness;
}

Eigen::VectorXd round_segment_masses(const Points3& centreline, const Eigen::VectorXd& radii,
                                     double density) {
  Eigen::VectorXd masses(radii.size() - 1);
  for (int s = 0; s < masses.size(); ++s)
    masses[s] = density * std::numbers::pi * std::pow(0.5 * (radii[s] + radii[s + 1]), 2) *
                (centreline.row(s + 1) - centreline.row(s)).norm();
  return masses;
}

}  // namespace wilt
