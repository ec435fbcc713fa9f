// Layouts of data sets: what check_dataset.py cannot see from outside.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <numeric>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/random.hpp"
#include "wilt/dataset/coco.hpp"
#include "wilt/dataset/webdataset.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;

class Dataset : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        testing::TempDir() + "wilt_dataset_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::string folder_;
};

Image mask_of(int width, int height, const std::function<bool(int, int)>& leaf) {
  Image mask{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mask.rgb.insert(mask.rgb.end(), 3, leaf(x, y) ? 255 : 0);
  return mask;
}

// Known: the examples of the format. Property: decoding gives the mask back, whatever it is; the seed is
// fixed.
TEST(RunLengths, GoColumnByColumnBackgroundFirst) {
  using Runs = std::vector<std::uint32_t>;
  EXPECT_EQ(run_lengths(mask_of(3, 2, [](int, int) { return false; })), (Runs{6}));
  EXPECT_EQ(run_lengths(mask_of(3, 2, [](int, int) { return true; })), (Runs{0, 6}));
  EXPECT_EQ(run_lengths(mask_of(3, 2, [](int x, int y) { return x == 1 && y == 1; })), (Runs{3, 1, 2}));
  EXPECT_EQ(run_lengths(mask_of(3, 2, [](int, int y) { return y == 0; })), (Runs{0, 1, 1, 1, 1, 1, 1}));
  Random random(5, "masks");
  for (int round = 0; round < 50; ++round) {
    const int width = 1 + random.index(9), height = 1 + random.index(9);
    std::vector<bool> leaf;
    for (int i = 0; i < width * height; ++i) leaf.push_back(random.index(3) == 0);
    const Runs runs = run_lengths(mask_of(width, height, [&](int x, int y) { return leaf[x * height + y]; }));
    std::vector<bool> decoded;
    for (std::size_t i = 0; i < runs.size(); ++i) decoded.insert(decoded.end(), runs[i], i % 2 == 1);
    EXPECT_EQ(decoded, leaf);
  }
}

CocoPicture picture() {
  return {"a.png", "maple", encode_png(mask_of(4, 3, [](int x, int) { return x == 1; })),
          R"({"width": 4, "height": 3, "box": [1, 0, 1, 3], "area": 3, "base": [1, 2, 2], "apex": null,)"
          R"( "tips": []})"};
}

// Negative: what cannot be annotated is named, and nothing of the file is seen.
TEST_F(Dataset, RefusesLabelsThatDoNotFit) {
  const auto message = [&](const CocoPicture& wrong) -> std::string {
    CocoWriter writer(path("coco.json"));
    writer.add(picture());
    try {
      writer.add(wrong);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      return error.what();
    }
    return "";
  };
  CocoPicture wrong = picture();
  wrong.labels = R"({"width": 5, "height": 3})";
  EXPECT_NE(
      message(wrong).find("'a.png' cannot be annotated: its mask has 4 x 3 pixels, its labels say 5 x 3"),
      std::string::npos)
      << message(wrong);
  wrong.labels = R"({"width": 4, "height": 3})";
  EXPECT_NE(message(wrong).find("its labels are not what wilt writes"), std::string::npos);
  wrong = picture(), wrong.mask = "no picture";
  EXPECT_NE(message(wrong).find("'a.png' cannot be annotated: its mask cannot be read"), std::string::npos);
  EXPECT_TRUE(entries().empty());
}

// Invariance: the same pictures give the same bytes. A leaf without an apex has a keypoint that is not there.
TEST_F(Dataset, WritesTheSameFileAgain) {
  for (const char* name : {"a.json", "b.json"}) {
    CocoWriter writer(path(name));
    for (int i = 0; i < 3; ++i) writer.add(picture());
    writer.finish();
  }
  const std::string bytes = read_file(path("a.json"));
  EXPECT_EQ(bytes, read_file(path("b.json")));
  EXPECT_NE(bytes.find(R"("keypoints":[1,2,2,0,0,0],"num_keypoints":1)"), std::string::npos) << bytes;
}

// Property: a shard that is not finished is not there; shards of an earlier, longer run go.
TEST_F(Dataset, HasOnlyWholeShards) {
  const std::vector<SampleFile> files{{"json", "{}"}, {"leaf.png", std::string(100000, 'x')}};
  {
    WebDatasetWriter writer(folder_, {2});
    for (int i = 0; i < 5; ++i) writer.add("key" + std::to_string(i), files);
    EXPECT_EQ(entries(), (std::vector<std::string>{"shard-000000.tar", "shard-000001.tar"}));
  }
  EXPECT_EQ(entries().size(), 2U);  // and no temporary file
  const std::string first = read_file(path("shard-000000.tar"));
  WebDatasetWriter shorter(folder_, {2});
  for (int i = 0; i < 2; ++i) shorter.add("key" + std::to_string(i), files);
  EXPECT_EQ(shorter.finish(), (std::vector<std::string>{"shard-000000.tar"}));
  EXPECT_EQ(entries(), (std::vector<std::string>{"shard-000000.tar"}));
  EXPECT_EQ(read_file(path("shard-000000.tar")), first);
}

TEST_F(Dataset, BeginsANewShardAfterSoManyBytes) {
  WebDatasetWriter writer(folder_, {1000, 150000});
  for (int i = 0; i < 5; ++i) writer.add(std::to_string(i), {{"bin", std::string(100000, 'x')}});
  EXPECT_EQ(writer.finish().size(), 3U);
  EXPECT_EQ(fs::file_size(path("shard-000002.tar")), 512 + 100352 + 1024U);  // header, whole blocks, end
}

TEST_F(Dataset, SaysWhatIsWrong) {
  EXPECT_THROW(WebDatasetWriter(folder_, {0}), Error);
  EXPECT_THROW(WebDatasetWriter(folder_, {1, 0}), Error);
  WebDatasetWriter writer(folder_);
  EXPECT_THROW(writer.add("a.b", {{"json", ""}}), std::logic_error);
  EXPECT_THROW(writer.add("", {{"json", ""}}), std::logic_error);
  EXPECT_THROW(writer.add("a", {}), std::logic_error);
  WebDatasetWriter nowhere(path("missing"));
  try {
    nowhere.add("a", {{"json", ""}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_NE(std::string(error.what()).find("mkdir -p"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
