#include "wilt/import/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <limits>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

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

}  // namespace

TriangleSoup read_mesh_file(const std::filesystem::path& file, std::vector<std::string>& notes) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw Error(ErrorCode::input,
                fmt::format("'{}' cannot be read as a mesh: {}", file.filename().string(),
                            scene == nullptr ? importer.GetErrorString() : "it holds no scene"));
  std::vector<Instance> parts;
  collect(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), parts);
  const auto stalks =
      std::count_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; });
  if (stalks > 0 && stalks < static_cast<std::ptrdiff_t>(parts.size())) {
    parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; }),
                parts.end());
    notes.push_back("the part named 'stalk' was left out; the blade alone is a leaf");
  }

  int vertices = 0;
  for (const Instance& part : parts) vertices += static_cast<int>(part.mesh->mNumVertices);
  TriangleSoup soup;
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

}  // namespace wilt::detail
