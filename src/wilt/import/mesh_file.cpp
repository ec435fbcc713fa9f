#include "wilt/import/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/BaseImporter.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cstring>
#include <limits>
#include <new>
#include <set>

#include "wilt/core/error.hpp"
#include "wilt/import/isolated.hpp"
#include "wilt/import/mesh_folder.hpp"
#include "wilt/import/packing.hpp"

namespace wilt::detail {
namespace {

constexpr std::int64_t kMostVertices = 50'000'000;
const std::string kName = "leaf";  // what the library is told, with the extension

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
                      fmt::format("face {} has vertex {}, but there are {} (counted from 0); remove the face",
                                  f, static_cast<int>(face.mIndices[k]), mesh.mNumVertices));
      }
    }
  }
}

// Of the first chunk.
std::size_t glb_json_size(std::string_view glb) {
  std::uint32_t size = 0;  // little-endian, as is every processor that we build for
  if (glb.size() >= 16) std::memcpy(&size, glb.data() + 12, sizeof size);
  return size;
}

// The library's readers of JSON call themselves for every level.
void check_depth(std::string_view bytes, const std::string& extension) {
  constexpr int kDeepest = 200;
  if (extension == ".glb")
    bytes = bytes.substr(std::min<std::size_t>(20, bytes.size()), glb_json_size(bytes));
  else if (extension != ".gltf")
    return;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest)
        throw Error(ErrorCode::input, fmt::format("its JSON is nested deeper than {} levels", kDeepest));
    } else if (c == ']' || c == '}') {
      --depth;
    } else {
      in_string = c == '"';
    }
  }
}

// Why the library could not read it, in our words where its own help nobody.
std::string reason_of(std::string words, const std::string& extension) {
  while (!words.empty() && (words.back() == '.' || words.back() == '\n')) words.pop_back();
  for (const char* unknown : {"No suitable reader", "Failed to determine STL", "Incorrect magic number"})
    if (words.find(unknown) != words.npos)
      return fmt::format("its content is not that of a {} file", extension);
  constexpr std::size_t kMost = 200;  // some quote the rest of the file
  return words.size() > kMost ? words.substr(0, kMost) + " [and more]" : words;
}

[[noreturn]] void refuse(const Assimp::Importer& importer, const std::string& extension) {
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
  const std::string reason = reason_of(importer.GetErrorString(), extension);
  throw Error(ErrorCode::input,
              fmt::format("it cannot be read as a mesh: {}", reason.empty() ? "it holds no scene" : reason));
}

const aiScene& load(Assimp::Importer& importer, const std::string& extension) {
  const auto usable = [](const aiScene* scene) { return scene != nullptr && scene->mRootNode != nullptr; };
  const aiScene* scene = importer.ReadFile(kName + extension, 0);
  if (!usable(scene)) refuse(importer, extension);
  check_indices(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!usable(scene)) refuse(importer, extension);
  return *scene;
}

// The parts that are the blade's.
std::vector<Instance> blade_parts(const aiScene& scene, std::vector<std::string>& notes) {
  std::vector<Instance> parts;
  collect(scene, *scene.mRootNode, Eigen::Matrix4d::Identity(), parts);
  const auto stalks =
      std::count_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; });
  if (stalks > 0 && stalks < static_cast<std::ptrdiff_t>(parts.size())) {
    parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Instance& part) { return part.stalk; }),
                parts.end());
    notes.push_back("the part named 'stalk' was left out; the blade alone is a leaf");
  }
  return parts;
}

// Hears the library say that it left faces out, which it tells no other way.
class LeftOut {
 public:
  LeftOut() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Listener(heard_),
                                               Assimp::Logger::Warn);  // deleted by kill
  }
  LeftOut(const LeftOut&) = delete;
  LeftOut& operator=(const LeftOut&) = delete;
  ~LeftOut() { Assimp::DefaultLogger::kill(); }

  bool heard() const { return heard_; }

 private:
  class Listener : public Assimp::LogStream {
   public:
    explicit Listener(bool& heard) : heard_(heard) {}
    void write(const char* message) override {
      if (std::strstr(message, "out-of-range indices") != nullptr) heard_ = true;
    }

   private:
    bool& heard_;
  };

  bool heard_ = false;
};

}  // namespace

TriangleSoup parse_mesh(std::string_view bytes, const std::string& extension,
                        const std::filesystem::path& folder) {
  check_depth(bytes, extension);
  const LeftOut left_out;
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshFolder(bytes, kName + extension, folder));  // the importer deletes it
  keep_only(importer, extension);
  TriangleSoup soup;
  const std::vector<Instance> parts = blade_parts(load(importer, extension), soup.notes);
  if (left_out.heard()) soup.notes.push_back("faces with vertices that the file does not have were left out");
  std::int64_t vertices = 0;
  for (const Instance& part : parts) vertices += part.mesh->mNumVertices;
  if (vertices > kMostVertices)
    throw Error(ErrorCode::input, fmt::format("it has {} vertices; {} are allowed: simplify it first",
                                              vertices, kMostVertices));
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
    Packer packer;
    packer.matrix(soup.positions);
    packer.matrix(soup.uv);
    packer.matrix(soup.faces);
    packer.texts(soup.notes);
    return packer.take();
  };
  const std::string packed = run_isolated("the mesh reader", parse, monitor);
  Unpacker unpacker(packed);
  TriangleSoup soup;
  soup.positions = unpacker.matrix<Points3>();
  soup.uv = unpacker.matrix<Points2>();
  soup.faces = unpacker.matrix<Faces>();
  soup.notes = unpacker.texts();
  return soup;
}

}  // namespace wilt::detail
