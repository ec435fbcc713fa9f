// Least squares conformal maps, Levy et al. 2002: U = u + i v per vertex minimises
//     sum_T |W_1 U_1 + W_2 U_2 + W_3 U_3|^2 / (2 A_T),  W_1 = z_3 - z_2, W_2 = z_1 - z_3, W_3 = z_2 - z_1,
// z_k the corners of T in its own plane as complex numbers, A_T its area; two vertices are pinned.
#include "wilt/import/flatten.hpp"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <complex>
#include <optional>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt::detail {
namespace {

using Complex = std::complex<double>;

double signed_area(const Points2& flat, const std::array<VertexId, 3>& v) {
  const Eigen::RowVector2d a = flat.row(v[0]), b = flat.row(v[1]), c = flat.row(v[2]);
  return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
}

bool one_to_one(const SurfaceMesh& mesh, const Points3& positions, const Points2& flat, double least_ratio) {
  const FaceData<double> areas = face_areas(mesh, positions);
  for (const FaceId f : mesh.faces()) {
    if (!(signed_area(flat, mesh.face_vertices(f)) > least_ratio * areas[f])) return false;
  }
  try {
    validate_outline(boundary_outline(mesh, positions, flat));
  } catch (const Error&) {
    return false;
  }
  return true;
}

// The two ends of the margin that are farthest apart along it stay where they are, at their distance.
std::optional<Points2> conformal_map(const SurfaceMesh& mesh, const Points3& positions) {
  const std::vector<VertexId>& margin = margin_loop(mesh, positions);
  const VertexId pin_a = margin.front(), pin_b = margin[margin.size() / 2];
  const int n = mesh.num_vertices();
  std::vector<int> column(n);
  int next = 0;
  for (int v = 0; v < n; ++v) column[v] = v == pin_a ? -1 : v == pin_b ? -2 : next++;
  const Complex pinned_b((positions.row(pin_b) - positions.row(pin_a)).norm(), 0.0);

  std::vector<Eigen::Triplet<Complex>> entries;
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(mesh.num_faces());
  for (const FaceId f : mesh.faces()) {
    const auto v = mesh.face_vertices(f);
    const Vec3 a = positions.row(v[0]), b = positions.row(v[1]), c = positions.row(v[2]);
    const Vec3 x = (b - a).normalized(), normal = (b - a).cross(c - a);
    const Vec3 y = normal.normalized().cross(x);
    const Complex z[3] = {0.0, (b - a).norm(), Complex((c - a).dot(x), (c - a).dot(y))};
    const double root = std::sqrt(normal.norm());
    for (int k = 0; k < 3; ++k) {
      const Complex w = (z[(k + 2) % 3] - z[(k + 1) % 3]) / root;
      if (column[v[k]] >= 0)
        entries.emplace_back(int(f), column[v[k]], w);
      else if (column[v[k]] == -2)
        right[f] -= w * pinned_b;
    }
  }
  Eigen::SparseMatrix<Complex> m(mesh.num_faces(), n - 2);
  m.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<Complex> normal_matrix = m.adjoint() * m;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> solver(normal_matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXcd solution = solver.solve(m.adjoint() * right);
  Points2 flat(n, 2);
  for (int v = 0; v < n; ++v) {
    const Complex u = column[v] >= 0 ? solution[column[v]] : column[v] == -2 ? pinned_b : Complex(0.0);
    flat.row(v) << u.real(), u.imag();
  }
  return flat;
}

}  // namespace

Points2 project_to_plane(const SurfaceMesh& mesh, const Points3& positions) {
  const Vec3 normal = area_vector(mesh, positions).normalized();
  int smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  const Vec3 u = normal.cross(Vec3::Unit(smallest)).normalized(), v = normal.cross(u);
  Points2 flat(positions.rows(), 2);
  flat.col(0) = positions * u;
  flat.col(1) = positions * v;
  return flat;
}

Outline boundary_outline(const SurfaceMesh& mesh, const Points3& positions, const Points2& flat) {
  const auto ring_of = [&](const std::vector<VertexId>& loop) {
    Points2 ring(static_cast<int>(loop.size()), 2);
    for (std::size_t i = 0; i < loop.size(); ++i) ring.row(static_cast<int>(i)) = flat.row(loop[i]);
    return ring;
  };
  const std::vector<VertexId>& margin = margin_loop(mesh, positions);
  Outline outline;
  outline.margin = ring_of(margin);
  for (const std::vector<VertexId>& loop : mesh.boundary_loops()) {
    if (&loop != &margin) outline.holes.push_back(ring_of(loop));
  }
  return outline;
}

Points2 flatten_sheet(const SurfaceMesh& mesh, const Points3& positions) {
  constexpr double kLeastRatio = 0.2;  // below it triangles of the remeshed sheet would be too stretched
  Points2 flat = project_to_plane(mesh, positions);
  if (one_to_one(mesh, positions, flat, kLeastRatio)) return flat;
  if (const std::optional<Points2> conformal = conformal_map(mesh, positions)) {
    if (one_to_one(mesh, positions, *conformal, 0.0)) return *conformal;
  }
  throw Error(ErrorCode::input,
              "the surface cannot be laid out in the plane without overlap, which remeshing needs; "
              "leave --vertices out to keep the file's own vertices");
}

}  // namespace wilt::detail
