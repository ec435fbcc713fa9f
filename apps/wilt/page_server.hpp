// Files served to the browsers of this machine.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace wilt::cli {

/// Files by the path by which a browser asks for them, decoded: "/index.html".
using ServedFiles = std::map<std::string, std::filesystem::path>;

/// The regular files under a folder, as they stand now; links are left out. Throws Error{input} when the
/// folder cannot be read.
ServedFiles files_under(const std::filesystem::path& folder);

/// An HTTP server on 127.0.0.1. It gives the files that it was made with, each by its one name, "/index.html"
/// also for "/", and nothing else: there are no folders to list and no way out of them. It answers GET and
/// HEAD alone, and only who asks for 127.0.0.1 or localhost: a page of another host whose name was made to
/// point here is refused. Not for other machines.
class PageServer {
 public:
  /// Serves from now on, until it goes. `port` 0 takes any that is free. Throws Error{output} when it is
  /// taken.
  PageServer(ServedFiles files, int port);
  ~PageServer();

  int port() const;
  /// False once it has ended by itself.
  bool serving() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wilt::cli
