// What all ways to read a leaf have in common. For the import room and the page's core.
#pragma once

#include <new>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

/// Runs `read`; the message of what it refuses begins with `name`.
template <class Read>
auto naming(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input || std::string(error.what()).find(name + "'") != std::string::npos)
      throw;
    throw Error(ErrorCode::input, "'" + name + "': " + error.what());
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::input, "'" + name + "': reading it takes more memory than there is; simplify it");
  }
}

/// Throws Error{input}, naming the leaf, unless squares and cubes of its length are numbers too. Odd lengths
/// within these have their note.
void check_length(const Leaf& leaf, const std::string& name);

/// Throws Error{configuration} for a number of vertices or a petiole that no leaf can have.
void validate_size_and_petiole(const ReadOptions& options);

}  // namespace wilt::detail
