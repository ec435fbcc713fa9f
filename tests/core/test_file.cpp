#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/file_writer.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "wilt_file_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  int entries() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  // The message of the Error{output} that writing there throws.
  static std::string message(const std::string& where, std::string_view bytes = "x") {
    try {
      write_file(where, bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::output);
      return error.what();
    }
    ADD_FAILURE() << where << " was written";
    return "";
  }

  fs::path folder_;
};

mode_t mode_of(const std::string& path) {
  struct stat status;
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

void expect_in(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

// Oracle: the pieces. Before the end the old file stands; what is not finished leaves nothing.
TEST_F(WriteFile, WritesPiecesWholeOrNotAtAll) {
  write_file(path("a"), "old");
  ASSERT_EQ(::chmod(path("a").c_str(), 0640), 0);
  {
    FileWriter dropped(path("a"));
    dropped.write("dropped");
  }
  FileWriter writer(path("a"));
  const std::string piece(100000, 'p');
  for (int i = 0; i < 30; ++i) writer.write(piece);
  EXPECT_EQ(read_file(path("a")), "old");
  writer.finish();
  EXPECT_EQ(read_file(path("a")).size(), 30 * piece.size());
  EXPECT_EQ(mode_of(path("a")), 0640U);
  EXPECT_EQ(entries(), 1);
}

// Oracle: what was written.
TEST_F(WriteFile, ReadsBackWhatWasWrittenAndLeavesNothingElse) {
  const std::string bytes("a\0b\xff\n", 5);
  write_file(path("leaf.bin"), "longer than what follows");
  write_file(path("leaf.bin"), bytes);
  EXPECT_EQ(read_file(path("leaf.bin")), bytes);
  write_file(path("empty"), "");
  EXPECT_EQ(read_file(path("empty")), "");
  EXPECT_EQ(read_file(path("leaf.bin"), bytes.size()), bytes);
  EXPECT_THROW(read_file(path("leaf.bin"), bytes.size() - 1), Error);
  EXPECT_THROW(read_file("/dev/zero", 1000), Error) << "a device has no end";
  EXPECT_EQ(entries(), 2);
}

// Oracle: POSIX; a new file has 0666 less the umask, an old one what it had.
TEST_F(WriteFile, KeepsPermissionsAndRespectsTheUmask) {
  const mode_t before = ::umask(027);
  write_file(path("new"), "x");
  ::umask(before);
  EXPECT_EQ(mode_of(path("new")), 0640U);
  ASSERT_EQ(::chmod(path("new").c_str(), 0604), 0);
  write_file(path("new"), "y");
  EXPECT_EQ(mode_of(path("new")), 0604U);
}

// Oracle: the old bytes. A limit on the size of files stops the write half way (the disk is full, in effect).
TEST_F(WriteFile, LeavesTheOldFileWhenItFailsHalfWay) {
  write_file(path("leaf.glb"), "the old file");
  rlimit old_limit;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const rlimit small{4096, old_limit.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string text = message(path("leaf.glb"), std::string(100000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  expect_in(text, {"leaf.glb", "File too large", "ulimit"});
  EXPECT_EQ(read_file(path("leaf.glb")), "the old file");
  EXPECT_EQ(entries(), 1) << "a temporary file was left";
}

// Oracle: invariance. Whoever has the old file open goes on reading the old bytes.
TEST_F(WriteFile, ReplacesRatherThanOverwrites) {
  write_file(path("leaf"), "old");
  const int reader = ::open(path("leaf").c_str(), O_RDONLY);
  write_file(path("leaf"), "new");
  char bytes[4] = {};
  EXPECT_EQ(::read(reader, bytes, 3), 3);
  ::close(reader);
  EXPECT_STREQ(bytes, "old");
}

TEST_F(WriteFile, FollowsASymbolicLink) {
  write_file(path("target"), "old");
  fs::create_symlink("target", path("link"));
  write_file(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_file(path("target")), "new");
}

// Oracle: the bytes at the other end; more than a pipe holds (64 KiB), so that writes are partial.
TEST_F(WriteFile, WritesAPipeInPlace) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_file(path("pipe")); });
  const std::string bytes(300000, 'w');
  write_file(path("pipe"), bytes);
  reader.join();
  EXPECT_EQ(received, bytes);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_EQ(entries(), 1);
}

// Oracle: the descriptor that the name stands for gets the bytes after those that it has, and stays open.
TEST_F(WriteFile, WritesToAStandingDescriptorWhereItIs) {
  const int descriptor = ::open(path("log").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(descriptor, "first ", 6), 6);
  write_file("/dev/fd/" + std::to_string(descriptor), "second ");
  ASSERT_EQ(::write(descriptor, "third", 5), 5);
  ::close(descriptor);
  EXPECT_EQ(read_file(path("log")), "first second third");
}

// Oracle: negative; each reason with its fix.
TEST_F(WriteFile, SaysWhatIsWrongAndWhatToDo) {
  expect_in(message(path("none/leaf.glb")), {"none/leaf.glb", "No such file", "mkdir -p", "none'"});
  expect_in(message(folder_.string()), {"Is a directory", "name of a file"});
  expect_in(message("/dev/full"), {"/dev/full", "No space left", "free some space"});
  write_file(path("file"), "x");
  expect_in(message(path("file/leaf.glb")), {"Not a directory", "file, not a folder"});
  expect_in(message(path(std::string(300, 'n'))), {"File name too long", "shorter"});
  expect_in(message("/dev/fd/999"), {"/dev/fd/999", "Bad file descriptor"});
}

TEST_F(WriteFile, RefusesAFileThatMayNotBeWritten) {
  write_file(path("locked"), "old");
  ASSERT_EQ(::chmod(path("locked").c_str(), 0444), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  const bool root = ::geteuid() == 0;  // who may write anything, so be nobody for a while
  ASSERT_EQ(::seteuid(root ? 65534 : ::geteuid()), 0);
  const std::string text = message(path("locked"));
  ASSERT_EQ(::seteuid(root ? 0 : ::geteuid()), 0);
  expect_in(text, {"Permission denied", "chmod"});
  EXPECT_EQ(read_file(path("locked")), "old");
}

// Oracle: negative. "-" is a name like any other.
TEST_F(WriteFile, GivesNoMeaningToAHyphen) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  write_file("-", "x");
  fs::current_path(before);
  EXPECT_EQ(read_file(path("-")), "x");
}

TEST_F(WriteFile, ReadingAMissingFileIsAnInputError) {
  try {
    read_file(path("none.glb"));
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    expect_in(error.what(), {"none.glb", "No such file"});
  }
}

}  // namespace
}  // namespace wilt
