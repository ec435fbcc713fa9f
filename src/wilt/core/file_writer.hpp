// A file written piece by piece, whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace wilt {

/// What write_file (file.hpp) does, for files that are larger than one likes to hold in memory: nothing is
/// seen under the name before finish(), and without it nothing ever is. A pipe or a device is written in
/// place, piece by piece.
class FileWriter {
 public:
  explicit FileWriter(const std::string& path);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter();

  // All throw Error{output} as write_file does.
  void write(std::string_view bytes);
  void finish();  ///< flushes to the disk and gives the name; write no more

 private:
  void open();
  void begin_in_place(int descriptor);
  void begin_temporary(const std::string& target);
  void name_temporary();
  void flush();
  void take_name();

  std::string path_, target_;  // as given; the file to be replaced, links followed (empty: in place)
  std::string temporary_;      // the name that the file has now, or none
  int descriptor_ = -1;
  int mode_ = -1;  // of the file that is replaced; -1: there is none
};

}  // namespace wilt
