#include <limits>

#include "import/files.hpp"

namespace wilt {
namespace {

using ReadLeaf = test::Files;

TEST_F(ReadLeaf, ListsWhatIsAllowedForAnUnknownExtension) {
  const std::string message = refusal("a.svgg");
  EXPECT_NE(message.find("did you mean '.svg'"), std::string::npos) << message;
  EXPECT_NE(message.find(".obj .ply .stl .glb .gltf .svg .json"), std::string::npos) << message;
}

TEST_F(ReadLeaf, NamesAMissingFile) {
  EXPECT_NE(refusal("nowhere/leaf.obj").find("'nowhere/leaf.obj' does not exist"), std::string::npos);
}

TEST_F(ReadLeaf, ChecksItsOptions) {
  ReadOptions options;
  options.vertices = 10;
  EXPECT_NE(refusal("a.svg", options, ErrorCode::configuration).find("200 to 1000000"), std::string::npos);
  options = {};
  options.nth = 0;
  EXPECT_NE(refusal("a.svg", options, ErrorCode::configuration).find("1 or more"), std::string::npos);
  options.nth = 2;
  EXPECT_NE(refusal("a.obj", options, ErrorCode::configuration).find("only a photo, a drawing or a scan"),
            std::string::npos);
  options = {};
  options.threshold = 20.0;
  EXPECT_NE(refusal("a.obj", options, ErrorCode::configuration).find("go with a photo"), std::string::npos);
  EXPECT_NE(refusal("a.jpg", options).find("does not exist"), std::string::npos);
  options.threshold = 200.0;
  EXPECT_NE(refusal("a.jpg", options, ErrorCode::configuration).find("at most 100"), std::string::npos);
  options = {};
  options.petiole = Vec2(0, std::numeric_limits<double>::infinity());
  EXPECT_NE(refusal("a.svg", options, ErrorCode::configuration).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace wilt
