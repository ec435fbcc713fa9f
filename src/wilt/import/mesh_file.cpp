#include "wilt/import/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/BaseImporter.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstring>
#include <limits>
#include <new>
#include <set>

#include "wilt/core/error.hpp"
#include "wilt/import/isolated.hpp"
#include "wilt/import/mesh_folder.hpp"

namespace wilt::detail {
namespace {

constexpr std::int64_t kMostMeshVertices = 50'000'000;

struct Instance {
  const aiMesh* mesh;
  Eigen::Matrix4d transform;
  bool stalk;
};

bool is_stalk_name(const aiString& name) {
  return std::string(name.C_Str()).rfind("stalk", 0) == 0;
}

void collect(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent,
             std::vector<Instance>& found) {
  const aiMatrix4x4& m = node.mTransformation;
  Eigen::Matrix4d local;
  local << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  const Eigen::Matrix4d transform = parent * local;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh* mesh = scene.mMeshes[node.mMeshes[i]];
    found.push_back({mesh, transform, is_stalk_name(mesh->mName) || is_stalk_name(node.mName)});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) collect(scene, *node.mChildren[i], transform, found);
}

// The file's unit coordinates are kept bit for bit when nothing moves them.
void append(const Instance& part, int first_vertex, TriangleSoup& soup, std::vector<Eigen::Vector3i>& faces) {
  const aiMesh& mesh = *part.mesh;
  const bool moved = !part.transform.isIdentity(0.0);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    Vec3 p(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z);
    if (moved) p = (part.transform * p.homogeneous()).head<3>();
    const int row = first_vertex + static_cast<int>(v);
    soup.positions.row(row) = from_file_axes(p).transpose();
    if (mesh.HasTextureCoords(0))
      soup.uv.row(row) << mesh.mTextureCoords[0][v].x, 1.0 - double(mesh.mTextureCoords[0][v].y);
    else
      soup.uv.row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const bool mirrored = part.transform.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const int a = static_cast<int>(face.mIndices[0]), b = static_cast<int>(face.mIndices[mirrored ? 2 : 1]),
              c = static_cast<int>(face.mIndices[mirrored ? 1 : 2]);
    faces.push_back(Eigen::Vector3i(a, b, c) + Eigen::Vector3i::Constant(first_vertex));
  }
}

// Of all that the library can read, nothing but this kind of file.
void keep_only(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    std::set<std::string> extensions;
    reader->GetExtensionList(extensions);
    if (extensions.count(extension.substr(1)) > 0) continue;
    importer.UnregisterLoader(reader);
    delete reader;
  }
}

// The library's step that makes triangles trusts the indices; a reader may have passed wrong ones on.
void check_indices(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw Error(ErrorCode::input,
                      fmt::format("face {} has vertex {}, but there are {} (counted from 0)", f,
                                  face.mIndices[k], mesh.mNumVertices));
      }
    }
  }
}

const aiScene& load(Assimp::Importer& importer, const std::string& name) {
  const auto refuse_null = [&](const aiScene* scene) {
    if (scene != nullptr && scene->mRootNode != nullptr) return;
    if (const std::exception_ptr& reason = importer.GetException()) {
      try {
        std::rethrow_exception(reason);
      } catch (const Error&) {  // ours, from mesh_folder
        throw;
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception&) {  // told by GetErrorString
      }
    }
    throw Error(ErrorCode::input,
                fmt::format("it cannot be read as a mesh: {}",
                            scene == nullptr ? importer.GetErrorString() : "it holds no scene"));
  };
  const aiScene* scene = importer.ReadFile(name, 0);
  refuse_null(scene);
  check_indices(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  refuse_null(scene);
  return *scene;
}

// The parts that are the blade's.
std::vector<Instance> blade_parts(const aiScene& scene, bool& stalk_left_out) {
  std::vector<Instance> parts;
  collect(scene, *scene.mRootNode, Eigen::Matrix4d::Identity(), parts);
  const auto stalks =
      std::count_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; });
  stalk_left_out = stalks > 0 && stalks < static_cast<std::ptrdiff_t>(parts.size());
  if (stalk_left_out)
    parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; }),
                parts.end());
  return parts;
}

template <class Matrix>
void pack(std::string& bytes, const Matrix& matrix) {
  const std::int64_t rows = matrix.rows();
  bytes.append(reinterpret_cast<const char*>(&rows), sizeof rows);
  bytes.append(reinterpret_cast<const char*>(matrix.data()), sizeof(*matrix.data()) * matrix.size());
}

template <class Matrix>
void unpack(std::string_view& bytes, Matrix& matrix) {
  std::int64_t rows = 0;
  std::memcpy(&rows, bytes.data(), sizeof rows);
  matrix.resize(rows, matrix.cols());
  bytes.remove_prefix(sizeof rows);
  const std::size_t length = sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size());
  if (length > 0) std::memcpy(matrix.data(), bytes.data(), length);
  bytes.remove_prefix(length);
}

}  // namespace

TriangleSoup parse_mesh(std::string_view bytes, const std::string& extension,
                        const std::filesystem::path& folder) {
  const std::string name = "leaf" + extension;
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshFolder(bytes, name, folder));  // the importer deletes it
  keep_only(importer, extension);
  TriangleSoup soup;
  const std::vector<Instance> parts = blade_parts(load(importer, name), soup.stalk_left_out);
  std::int64_t vertices = 0;
  for (const Instance& part : parts) vertices += part.mesh->mNumVertices;
  if (vertices > kMostMeshVertices)
    throw Error(ErrorCode::input, fmt::format("it has {} vertices; {} are allowed: simplify it first",
                                              vertices, kMostMeshVertices));
  soup.positions.resize(vertices, 3);
  soup.uv.resize(vertices, 2);
  std::vector<Eigen::Vector3i> faces;
  int first = 0;
  for (const Instance& part : parts) {
    append(part, first, soup, faces);
    first += static_cast<int>(part.mesh->mNumVertices);
  }
  soup.faces.resize(static_cast<int>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) soup.faces.row(static_cast<int>(f)) = faces[f].transpose();
  return soup;
}

TriangleSoup read_mesh(std::string_view bytes, const std::string& extension,
                       const std::filesystem::path& folder, const Monitor& monitor) {
  const auto parse = [&] {
    const TriangleSoup soup = parse_mesh(bytes, extension, folder);
    std::string packed(1, static_cast<char>(soup.stalk_left_out));
    pack(packed, soup.positions);
    pack(packed, soup.uv);
    pack(packed, soup.faces);
    return packed;
  };
  const std::string packed = run_isolated("the mesh reader", parse, monitor);
  TriangleSoup soup;
  soup.stalk_left_out = packed[0] != 0;
  std::string_view rest = std::string_view(packed).substr(1);
  unpack(rest, soup.positions);
  unpack(rest, soup.uv);
  unpack(rest, soup.faces);
  return soup;
}

}  // namespace wilt::detail
