#include "wilt/output/vtk.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <utility>

#include "wilt/core/file.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/core/version.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/byte_order.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/markup.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {
namespace {

template <class Number>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<float> = "Float32";
template <>
constexpr const char* kTypeName<std::int32_t> = "Int32";
template <>
constexpr const char* kTypeName<std::uint8_t> = "UInt8";

/// The XML of a grid, with the arrays' bytes that follow it.
class Grid {
 public:
  std::string xml, appended;

  void open(const std::string& tag) { xml += "<" + tag + ">\n"; }
  void close(const std::string& tag) { xml += "</" + tag + ">\n"; }

  /// An array of rows, as Number.
  template <class Number, class Rows>
  void array(const char* name, const Rows& rows) {
    xml += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        kTypeName<Number>, name, rows.cols(), appended.size());
    append_little_endian(appended, static_cast<std::uint64_t>(rows.size()) * sizeof(Number));
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      for (Eigen::Index c = 0; c < rows.cols(); ++c)
        append_little_endian(appended, static_cast<Number>(rows(i, c)));
    }
  }

  /// A number of the whole grid.
  void field(const char* name, double value) {
    xml += fmt::format(
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
        name, value);
  }
};

std::string opening(const char* type, const Clip& clip) {
  std::string config = clip.config;  // a comment may not hold two hyphens in a row
  for (std::size_t at = config.find("--"); at != std::string::npos; at = config.find("--"))
    config.replace(at, 2, "- ");
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- wilt {}, units: {}, up: Y, config: {} -->\n"
      "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
      version(), unit_name(clip.leaf.placement), config, type);
}

double hours_of(const Clip& clip, int frame, const ClipOptions& options) {
  return options.hours_per_iteration * clip.frames[static_cast<std::size_t>(frame)].iteration;
}

void append_fields(Grid& grid, const Clip& clip, int frame, const ClipOptions& options) {
  grid.open("FieldData");
  grid.field("TimeValue", hours_of(clip, frame, options));
  grid.field("iteration", clip.frames[static_cast<std::size_t>(frame)].iteration);
  grid.field("metres_per_unit", metres_per_unit(clip.leaf.placement));
  grid.close("FieldData");
}

void append_mesh(Grid& grid, const Points3& positions, const Faces& faces) {
  constexpr std::uint8_t kTriangle = 5;
  const int count = static_cast<int>(faces.rows());
  grid.open("Points");
  grid.array<float>("Points", positions);
  grid.close("Points");
  grid.open("Cells");
  grid.array<std::int32_t>("connectivity", faces.reshaped<Eigen::RowMajor>().eval());
  grid.array<std::int32_t>("offsets", Eigen::VectorXi::LinSpaced(count, 3, 3 * count).eval());
  grid.array<std::uint8_t>("types", Eigen::VectorXi::Constant(count, kTriangle).eval());
  grid.close("Cells");
}

void append_looks(Grid& grid, const Shape& shape, const Shape& rest, const Points3& linear) {
  const SrgbBytes encode;
  grid.array<float>("Normals", shape.normals);
  grid.array<float>("displacement", (shape.positions - rest.positions).eval());
  grid.array<std::uint8_t>("colour", linear.unaryExpr([&encode](double c) { return int{encode(c)}; }).eval());
}

Eigen::VectorXd areas(const Points3& positions, const Faces& faces) {
  Eigen::VectorXd result(faces.rows());
  for (int f = 0; f < faces.rows(); ++f) {
    const Vec3 a = positions.row(faces(f, 0)), b = positions.row(faces(f, 1)), c = positions.row(faces(f, 2));
    result[f] = 0.5 * (b - a).cross(c - a).norm();
  }
  return result;
}

std::string finish(const Clip& clip, Grid grid) {
  return opening("UnstructuredGrid", clip) + "<UnstructuredGrid>\n" + grid.xml +
         "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + grid.appended +
         "\n</AppendedData>\n</VTKFile>\n";
}

std::string piece(Eigen::Index points, Eigen::Index cells) {
  return fmt::format("Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", points, cells);
}

}  // namespace

std::string vtu_blade(const ShownColours& shown, int frame, const ClipOptions& options) {
  options.validate();
  const Clip& clip = shown.clip();
  const Frame& state = clip.frames[static_cast<std::size_t>(frame)];
  const Shape shape = blade_shape(clip, frame), rest = blade_shape(clip, 0);
  const Faces faces = clip.leaf.mesh.face_matrix();
  Grid grid;
  append_fields(grid, clip, frame, options);
  grid.open(piece(shape.positions.rows(), faces.rows()));
  grid.open("PointData Scalars=\"dryness\" Normals=\"Normals\"");
  append_looks(grid, shape, rest, shown.blade(frame));
  if (state.dryness.size() > 0) grid.array<float>("dryness", state.dryness);
  if (state.water_fraction.size() > 0) grid.array<float>("water", state.water_fraction);
  grid.close("PointData");
  grid.open("CellData");
  grid.array<float>("area_ratio",
                    areas(shape.positions, faces).cwiseQuotient(areas(rest.positions, faces)).eval());
  grid.close("CellData");
  append_mesh(grid, shape.positions, faces);
  return finish(clip, std::move(grid));
}

std::string vtu_stalk(const ShownColours& shown, int frame, const ClipOptions& options) {
  options.validate();
  const Clip& clip = shown.clip();
  const Moving stalk = moving_stalk(clip, options.stalk_sides);
  const Shape shape = stalk.shape(frame);
  Grid grid;
  append_fields(grid, clip, frame, options);
  grid.open(piece(shape.positions.rows(), stalk.faces.rows()));
  grid.open("PointData Normals=\"Normals\"");
  append_looks(grid, shape, stalk.shape(0),
               shown.stalk(frame).transpose().replicate(shape.positions.rows(), 1));
  grid.close("PointData");
  append_mesh(grid, shape.positions, stalk.faces);
  return finish(clip, std::move(grid));
}

void write_vtu(const std::string& path, const ShownColours& shown, int frame, const ClipOptions& options) {
  write_file(path, vtu_blade(shown, frame, options));
}

std::string pvd_blade_path(const std::string& path, int frame) {
  return beside(path, fmt::format("_{:04}.vtu", frame));
}

std::string pvd_stalk_path(const std::string& path, int frame) {
  return beside(path, fmt::format("_stalk_{:04}.vtu", frame));
}

void write_pvd(const std::string& path, const ShownColours& shown, const ClipOptions& options) {
  const Clip& clip = shown.clip();
  std::string list = opening("Collection", clip) + "<Collection>\n";
  const auto add = [&](int frame, int part, const std::string& file, const std::string& bytes) {
    write_file(file, bytes);
    list += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n",
                        hours_of(clip, frame, options), part, markup_text(file_name(file)));
  };
  for (int k = 0; k < static_cast<int>(clip.frames.size()); ++k) {
    add(k, 0, pvd_blade_path(path, k), vtu_blade(shown, k, options));
    if (clip.frames.front().stalk.rows() >= 2)
      add(k, 1, pvd_stalk_path(path, k), vtu_stalk(shown, k, options));
  }
  write_file(path, list + "</Collection>\n</VTKFile>\n");
}

}  // namespace wilt
