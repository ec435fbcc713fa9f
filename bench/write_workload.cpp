// Writes the workload for the peers that are scripts: `write_workload mesh N` as OBJ, `write_workload
// distances N` as doubles (the number of vertices, all pairs' distances, the classical start by rows), to
// standard output.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench/workload.hpp"
#include "wilt/embedding/embedding.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"

namespace {

using namespace wilt;

void write_mesh(const bench::Surface& surface) {
  for (int v = 0; v < surface.positions.rows(); ++v)
    std::printf("v %.9g %.9g %.9g\n", surface.positions(v, 0), surface.positions(v, 1),
                surface.positions(v, 2));
  const Faces& faces = surface.mesh.face_matrix();
  for (int f = 0; f < faces.rows(); ++f)
    std::printf("f %d %d %d\n", faces(f, 0) + 1, faces(f, 1) + 1, faces(f, 2) + 1);
}

void write_distances(const bench::Surface& surface) {
  const Eigen::MatrixXd distances = all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast);
  const Points2 start = classical_mds(distances).coordinates;
  const double count = static_cast<double>(distances.rows());
  std::fwrite(&count, sizeof count, 1, stdout);
  std::fwrite(distances.data(), sizeof(double), static_cast<std::size_t>(distances.size()), stdout);
  std::fwrite(start.data(), sizeof(double), static_cast<std::size_t>(start.size()), stdout);
}

}  // namespace

int main(int argument_count, char** arguments) {
  const int vertices = argument_count == 3 ? std::atoi(arguments[2]) : 0;
  if (vertices > 0 && std::strcmp(arguments[1], "mesh") == 0) {
    write_mesh(bench::leaf_surface(vertices));
  } else if (vertices > 0 && std::strcmp(arguments[1], "distances") == 0) {
    write_distances(bench::leaf_surface(vertices));
  } else {
    std::fprintf(stderr, "usage: write_workload mesh|distances VERTICES > FILE\n");
    return 2;
  }
  return 0;
}
