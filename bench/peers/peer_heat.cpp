// The heat method (Crane, Weischedel, Wardetzky 2013) on two CHOLMOD factorisations, time h^2, h the mean
// edge.
#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>

#include "bench/geodesic_error.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt::bench {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

class HeatMethod {
 public:
  explicit HeatMethod(const Surface& surface) : faces_(surface.mesh.face_matrix()) {
    const int count = surface.mesh.num_vertices();
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(count);
    triangles_.reserve(static_cast<std::size_t>(faces_.rows()));
    for (int f = 0; f < faces_.rows(); ++f) add_triangle(surface.positions, f, entries, areas);
    SparseMatrix laplacian(count, count), mass(count, count);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    mass = areas.asDiagonal();
    const double h = mean_edge_length(surface.mesh, surface.positions);
    flow_.compute(SparseMatrix(mass + h * h * laplacian));
    poisson_.compute(SparseMatrix(laplacian + 1e-8 * mass));
  }

  Eigen::VectorXd distances(int source) const {
    const Eigen::VectorXd heat = flow_.solve(Eigen::VectorXd::Unit(poisson_.rows(), source));
    Eigen::VectorXd divergence = Eigen::VectorXd::Zero(heat.size());
    for (int f = 0; f < faces_.rows(); ++f) {
      const Triangle& t = triangles_[static_cast<std::size_t>(f)];
      Vec3 slope = Vec3::Zero();
      for (int c = 0; c < 3; ++c) slope += heat[faces_(f, c)] * t.hat_gradients.col(c);
      const double steepness = slope.norm();
      if (steepness == 0.0) continue;
      for (int c = 0; c < 3; ++c)
        divergence[faces_(f, c)] -= t.area * t.hat_gradients.col(c).dot(slope) / steepness;
    }
    const Eigen::VectorXd raw = poisson_.solve(divergence);
    return raw.array() - raw[source];
  }

 private:
  struct Triangle {
    Eigen::Matrix3d hat_gradients;  // of the three barycentric coordinates
    double area;
  };

  void add_triangle(const Points3& x, int f, std::vector<Eigen::Triplet<double>>& entries,
                    Eigen::VectorXd& areas) {
    Eigen::Matrix3d corner;
    for (int c = 0; c < 3; ++c) corner.col(c) = x.row(faces_(f, c)).transpose();
    const Vec3 normal = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0));
    Triangle t;
    t.area = 0.5 * normal.norm();
    for (int c = 0; c < 3; ++c)
      t.hat_gradients.col(c) =
          normal.cross(corner.col((c + 2) % 3) - corner.col((c + 1) % 3)) / normal.squaredNorm();
    const Eigen::Matrix3d stiffness = t.area * t.hat_gradients.transpose() * t.hat_gradients;
    for (int a = 0; a < 3; ++a) {
      areas[faces_(f, a)] += t.area / 3.0;
      for (int b = 0; b < 3; ++b) entries.emplace_back(faces_(f, a), faces_(f, b), stiffness(a, b));
    }
    triangles_.push_back(t);
  }

  const Faces& faces_;
  std::vector<Triangle> triangles_;
  Eigen::CholmodSupernodalLLT<SparseMatrix> flow_, poisson_;
};

void heat_all_pairs(benchmark::State& state) {
  const Surface surface = leaf_surface(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const HeatMethod heat(surface);
    for (int source = 0; source < surface.mesh.num_vertices(); ++source)
      benchmark::DoNotOptimize(heat.distances(source));
  }
  const HeatMethod heat(surface);
  report_error(state, surface, [&](VertexId source) { return heat.distances(source); });
}
BENCHMARK(heat_all_pairs)->Arg(1000)->Arg(5000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
