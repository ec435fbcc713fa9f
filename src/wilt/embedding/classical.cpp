// Classical scaling (Torgerson 1952).
//
//   D     #V x #V      distances
//   J     I - 1 1^T/n  centring
//   B     -1/2 J D^2 J (D^2 entry by entry), the Gram matrix of centred points when D is Euclidean
//   Q     #V x 8       orthonormal, turned by subspace iteration into B's leading eigenspace
//   T     Q^T B Q      its eigenpairs (Rayleigh and Ritz) tend to those of B
//
// The coordinates are sqrt(lambda) times the two leading eigenvectors. B is never formed. A block of vectors,
// rather than Lanczos, because B has rank 2 for a flat leaf and equal eigenvalues for a round one, where a
// single Krylov space breaks down; the spectrum of geodesic distances falls so fast that a few products do.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/core/random.hpp"
#include "wilt/embedding/distances.hpp"

namespace wilt {
namespace {

constexpr int kBlock = 8;
constexpr int kMaxProducts = 1000;
constexpr double kTolerance = 1e-12;  // residual of an eigenpair, in units of the largest eigenvalue
using Block = Eigen::Matrix<double, Eigen::Dynamic, kBlock, Eigen::RowMajor>;

/// B Q.
Block multiply(const Eigen::MatrixXd& distances, const Block& q) {
  const int n = static_cast<int>(distances.rows());
  const Block centred = q.rowwise() - q.colwise().mean();
  Block product(n, kBlock);
  parallel_for(n, 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const double* row = distances.col(i).data();
      Eigen::Array<double, 1, kBlock> sum = Eigen::Array<double, 1, kBlock>::Zero();
      for (int j = 0; j < n; ++j) sum += row[j] * row[j] * centred.row(j).array();
      product.row(i) = -0.5 * sum.matrix();
    }
  });
  product.rowwise() -= product.colwise().mean().eval();
  return product;
}

Block orthonormal(const Block& vectors) {
  // Padded with zero rows where there are fewer points than vectors.
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(vectors.rows(), kBlock), kBlock);
  padded.topRows(vectors.rows()) = vectors;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(padded);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(padded.rows(), kBlock);
  return q.topRows(vectors.rows());
}

struct LeadingPairs {
  Eigen::Vector2d values;    ///< descending
  Eigen::MatrixX2d vectors;  ///< #V x 2, unit
};

LeadingPairs leading_pairs(const Eigen::MatrixXd& distances) {
  Random random(1, "classical_mds");
  Block start(distances.rows(), kBlock);
  for (double& value : start.reshaped()) value = random.uniform(-1.0, 1.0);
  Block q = orthonormal(start);
  for (int product = 0; product < kMaxProducts; ++product) {
    const Block bq = multiply(distances, q);
    const Eigen::Matrix<double, kBlock, kBlock> t = q.transpose() * bq;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kBlock, kBlock>> ritz(0.5 *
                                                                                    (t + t.transpose()));
    const Eigen::Vector2d values = ritz.eigenvalues().tail<2>().reverse();  // they ascend
    const Eigen::Matrix<double, kBlock, 2> leading = ritz.eigenvectors().rightCols<2>().rowwise().reverse();
    const Eigen::MatrixX2d vectors = q * leading;
    const double residual = (bq * leading - vectors * values.asDiagonal()).norm();
    if (residual <= kTolerance * ritz.eigenvalues().cwiseAbs().maxCoeff()) return {values, vectors};
    q = orthonormal(bq);
  }
  throw Error(ErrorCode::input,
              fmt::format("classical_mds: the leading eigenvectors of the {0} x {0} distance matrix did not "
                          "converge in {1} products; distances on a disc-like surface are needed",
                          distances.rows(), kMaxProducts));
}

}  // namespace

Embedding classical_mds(const Eigen::MatrixXd& distances) {
  detail::validate_distances(distances);
  const LeadingPairs pairs = leading_pairs(distances);
  Embedding result;
  result.coordinates.resize(distances.rows(), 2);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::VectorXd q = pairs.vectors.col(axis);
    Eigen::Index largest = 0;
    q.cwiseAbs().maxCoeff(&largest);
    const double sign = q(largest) < 0.0 ? -1.0 : 1.0;  // eigenvectors have none of their own
    result.coordinates.col(axis) = sign * std::sqrt(std::max(pairs.values(axis), 0.0)) * q;
  }
  result.stress = detail::normalised_stress(distances, result.coordinates);
  return result;
}

}  // namespace wilt
