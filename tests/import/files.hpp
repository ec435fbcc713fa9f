// Files made by a test, in a folder of its own that goes away with it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/import/read_leaf.hpp"

namespace wilt::test {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "wilt_import_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  /// The message of the Error{input} that reading the file throws; "" when it throws none.
  std::string refusal(const std::filesystem::path& file, const ReadOptions& options = {},
                      ErrorCode code = ErrorCode::input) const {
    try {
      read_leaf(file, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

inline bool has_note(const Leaf& leaf, const std::string& words) {
  for (const std::string& note : leaf.notes) {
    if (note.find(words) != std::string::npos) return true;
  }
  return false;
}

/// Every note, for a test's message.
inline std::string notes_of(const Leaf& leaf) {
  std::string text;
  for (const std::string& note : leaf.notes) text += note + '\n';
  return text;
}

}  // namespace wilt::test
