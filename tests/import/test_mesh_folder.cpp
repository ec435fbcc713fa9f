// Which files a mesh file may name: those in its own folder, no others.
#include <sys/stat.h>

#include <filesystem>

#include "import/files.hpp"
#include "import/sheets.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;
using test::SheetFile;

class MeshFolder : public test::Files {
 protected:
  /// A .gltf in the folder "in" whose buffer is named `uri`.
  fs::path gltf(const std::string& uri) const {
    fs::create_directories(write("outside.bin", SheetFile().gltf_buffer()).parent_path() / "in" / "below");
    std::string text = SheetFile().gltf();
    const std::string name = "sheet.bin";
    text.replace(text.find(name), name.size(), uri);
    return write("in/leaf.gltf", text);
  }
};

// Oracle: the sheet is read where the rule allows it, from the file's folder or below it, by any spelling.
TEST_F(MeshFolder, ReadsBuffersInTheFilesFolder) {
  const SheetFile sheet;
  const auto vertices = [&](const std::string& uri, const std::string& file) {
    const fs::path leaf = gltf(uri);
    write("in/" + file, sheet.gltf_buffer());
    return read_leaf(leaf).mesh.num_vertices();
  };
  const int expected = static_cast<int>(sheet.points.size());
  EXPECT_EQ(vertices("sheet.bin", "sheet.bin"), expected);
  EXPECT_EQ(vertices("below/sheet.bin", "below/sheet.bin"), expected);
  EXPECT_EQ(vertices("below/../here.bin", "here.bin"), expected);
  EXPECT_EQ(vertices("two%20words.bin", "two words.bin"), expected);
  const fs::path linked = gltf("link.bin");
  fs::create_symlink("sheet.bin", linked.parent_path() / "link.bin");
  EXPECT_EQ(read_leaf(linked).mesh.num_vertices(), expected);
}

// Oracle: the buffer is there and would give a leaf, were it opened.
TEST_F(MeshFolder, OpensNothingElse) {
  const auto says = [&](const std::string& uri, const std::string& words) {
    const std::string message = refusal(gltf(uri));
    EXPECT_NE(message.find("leaf.gltf"), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << uri << ": " << message;
  };
  const fs::path outside = write("outside.bin", SheetFile().gltf_buffer());
  says("../outside.bin", "outside the folder");
  says("%2e%2e/outside.bin", "outside the folder");
  says("below/../../outside.bin", "outside the folder");
  says(outside.string(), "absolute path");
  says("file://" + outside.string(), "nothing is fetched");
  says("https://example.org/sheet.bin", "nothing is fetched");
  says("none.bin", "is missing");
  says("below", "no regular file");
  fs::create_symlink("../outside.bin", outside.parent_path() / "in" / "link.bin");
  says("link.bin", "outside the folder");
  fs::create_symlink("loop.bin", outside.parent_path() / "in" / "loop.bin");
  says("loop.bin", "is missing");
}

// Oracle: the same leaf with and without the material library, which nobody opens: here it is a pipe that
// would never end.
TEST_F(MeshFolder, OpensNoMaterialLibrary) {
  const std::string text = "mtllib leaf.mtl\nusemtl green\n" + SheetFile().obj();
  const Leaf without = read_leaf(write("leaf.obj", text));
  const fs::path file = write("leaf.obj", text);
  ASSERT_EQ(::mkfifo((file.parent_path() / "leaf.mtl").c_str(), 0600), 0);
  const Leaf with = read_leaf(file);
  EXPECT_EQ(with.mesh.num_faces(), without.mesh.num_faces());
  EXPECT_EQ(with.positions, without.positions);
}

}  // namespace
}  // namespace wilt
