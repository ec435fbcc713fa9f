// Names of the files that stand beside a result.
#pragma once

#include <string>
#include <string_view>

namespace wilt {

/// "DIR/NAME" of "DIR/NAME.EXT", with `ending` added: "DIR/NAME.texture.jpg".
std::string beside(const std::string& path, std::string_view ending);

/// The last part of a path: what a file that stands beside another calls it by.
std::string file_name(const std::string& path);

/// Whether the file's name has a row of hashes, in whose place stands a number: "leaf.####.obj".
bool is_sequence(const std::string& path);

/// The sequence's file of a number >= 0, with as many digits as hashes or more if it needs them. A sequence
/// has one row of hashes: check_sequence() throws Error{configuration} for another path.
std::string sequence_path(const std::string& pattern, int number);
void check_sequence(const std::string& pattern);

/// The pattern without its numbers, "leaf.obj" of "leaf.####.obj": names what all its files share.
std::string sequence_stem(const std::string& pattern);

}  // namespace wilt
