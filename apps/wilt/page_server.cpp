#include "page_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHost = "127.0.0.1";
constexpr int kThreads = 4;
constexpr int kKeepAlive = 1;  // seconds; what a connection that stays open may delay the end by

std::string mime_type(const fs::path& file) {
  static const std::map<std::string, std::string> types = {{".css", "text/css; charset=utf-8"},
                                                           {".gif", "image/gif"},
                                                           {".glb", "model/gltf-binary"},
                                                           {".gltf", "model/gltf+json"},
                                                           {".html", "text/html; charset=utf-8"},
                                                           {".ico", "image/x-icon"},
                                                           {".jpeg", "image/jpeg"},
                                                           {".jpg", "image/jpeg"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".json", "application/json"},
                                                           {".map", "application/json"},
                                                           {".mjs", "text/javascript; charset=utf-8"},
                                                           {".png", "image/png"},
                                                           {".svg", "image/svg+xml"},
                                                           {".txt", "text/plain; charset=utf-8"},
                                                           {".wasm", "application/wasm"},
                                                           {".webmanifest", "application/manifest+json"},
                                                           {".webp", "image/webp"},
                                                           {".woff2", "font/woff2"}};
  const auto found = types.find(extension_of(file.string()));
  return found == types.end() ? "application/octet-stream" : found->second;
}

// The names of the files in assets/ change with their contents; a leaf is edited while it is looked at.
const char* cache_control(const std::string& path) {
  if (path.rfind("/assets/", 0) == 0) return "public, max-age=31536000, immutable";
  return path.rfind("/leaf/", 0) == 0 ? "no-store" : "no-cache";
}

void refuse(httplib::Response& response, int status, const char* reason) {
  response.status = status;
  response.set_header("Connection", "close");  // what else came with the request is not read
  response.set_content(std::string(reason) + "\n", "text/plain; charset=utf-8");
}

}  // namespace

ServedFiles files_under(const fs::path& folder) {
  ServedFiles files;
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    if (entry->is_symlink() || !entry->is_regular_file()) continue;
    files["/" + entry->path().lexically_relative(folder).generic_string()] = entry->path();
  }
  if (failed)
    throw Error(ErrorCode::input, fmt::format("'{}' cannot be read: {}; check its permissions",
                                              folder.string(), failed.message()));
  return files;
}

struct PageServer::Impl {
  ServedFiles files;
  int port = 0;
  httplib::Server server;
  std::thread thread;

  bool is_for_us(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    for (const char* name : {kHost, "localhost"}) {
      if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name)) return true;
    }
    return false;
  }

  void answer(const httplib::Request& request, httplib::Response& response) const {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    if (!is_for_us(request)) return refuse(response, 403, "this page is for this machine alone");
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      return refuse(response, 405, "there is nothing to be done here but to read");
    }
    const auto found = files.find(request.path == "/" ? "/index.html" : request.path);
    if (found == files.end()) return refuse(response, 404, "there is no such file");
    std::shared_ptr<const std::string> bytes;
    try {
      bytes = std::make_shared<const std::string>(read_file(found->second.string()));
    } catch (const Error&) {
      return refuse(response, 404, "the file is gone");
    }
    response.set_header("Cache-Control", cache_control(found->first));
    // From memory, as a provider: else the library would compress what never leaves the machine.
    response.set_content_provider(bytes->size(), mime_type(found->second),
                                  [bytes](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return sink.write(bytes->data() + offset, length);
                                  });
  }
};

PageServer::PageServer(ServedFiles files, int port) : impl_(std::make_unique<Impl>()) {
  impl_->files = std::move(files);
  httplib::Server& server = impl_->server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_keep_alive_timeout(kKeepAlive);
  server.set_socket_options(
      [](socket_t socket) {  // the library's own would share the port with another server
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
      });
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    impl_->answer(request, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  const bool any = port == 0;
  impl_->port = any ? server.bind_to_any_port(kHost) : server.bind_to_port(kHost, port) ? port : 0;
  if (impl_->port <= 0)
    throw Error(
        ErrorCode::output,
        fmt::format("port {} of {} cannot be had, another program may use it; give another --port, or none",
                    port, kHost));
  impl_->thread = std::thread([&server] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::yield();
}

PageServer::~PageServer() {
  if (!impl_->thread.joinable()) return;
  impl_->server.stop();
  impl_->thread.join();
}

int PageServer::port() const {
  return impl_->port;
}

bool PageServer::serving() const {
  return impl_->server.is_running();
}

}  // namespace wilt::cli
