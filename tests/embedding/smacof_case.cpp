// Prints a case for smacof_against_sklearn.py: sizes, distances, start, iterates.
#include <cstdio>

#include "embedding/distances.hpp"
#include "wilt/embedding/embedding.hpp"

namespace {

constexpr int kPoints = 120;
constexpr int kFewIterations = 10;

template <class Matrix>
void print(const Matrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) std::printf("%.17g ", matrix(i, j));
    std::printf("\n");
  }
}

}  // namespace

int main() {
  const Eigen::MatrixXd distances = wilt::test::spherical_distances(wilt::test::scattered(kPoints, 2.0, 11));
  const wilt::Points2 start = wilt::test::scattered(kPoints, 1.0, 12);
  const wilt::Embedding few = wilt::smacof(distances, start, {kFewIterations, 1e-15});
  const wilt::Embedding converged = wilt::smacof(distances, start, {5000, 1e-10});
  std::printf("%d %d %.17g\n", kPoints, kFewIterations, converged.stress);
  print(distances);
  print(start);
  print(few.coordinates);
}
