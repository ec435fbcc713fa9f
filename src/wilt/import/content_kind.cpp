#include "wilt/import/content_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace wilt::detail {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view begin;  // the file's first bytes, behind blanks and a byte order mark
  std::string_view word;   // that stands in its first kilobytes too
  std::string_view name;
  std::string_view extensions;  // that it goes by; none: wilt does not read it
  std::string_view advice;      // for one that wilt does not read
};

constexpr std::string_view kExportPicture = "export it as PNG or JPEG",
                           kExportMesh = "export it as .glb or .obj";

constexpr std::array kKinds{
    Kind{"\x89PNG", "", "a PNG picture", ".png .jpg .jpeg", ""},  // pictures are told by their content
    Kind{"\xff\xd8\xff", "", "a JPEG picture", ".jpg .jpeg .png", ""},
    Kind{"glTF", "", "a binary glTF", ".glb", ""},
    Kind{"ply", "format ", "a PLY mesh", ".ply", ""},
    Kind{"solid", "facet", "an STL mesh", ".stl", ""},
    Kind{"v ", "\nv ", "an OBJ mesh", ".obj", ""},
    Kind{"mtllib", "", "an OBJ mesh", ".obj", ""},
    Kind{"{", "\"asset\"", "a glTF", ".gltf", ""},
    Kind{"{", "\"outline\"", "an outline in JSON", ".json", ""},
    Kind{"{", "\"veins\"", "a list of veins", "", "give it with --veins"},
    Kind{"<", "<svg", "a drawing (SVG)", ".svg", ""},
    Kind{"<", "<html", "a web page", "", "save the file itself, not the page that shows it"},
    Kind{"<", "<HTML", "a web page", "", "save the file itself, not the page that shows it"},
    Kind{"version https://git-lfs", "", "a pointer of Git LFS", "",
         "fetch the file itself with git lfs pull"},
    Kind{"GIF8", "", "a GIF picture", "", kExportPicture},
    Kind{"RIFF", "WEBP", "a WebP picture", "", kExportPicture},
    Kind{"II*", "", "a TIFF picture", "", kExportPicture},
    Kind{"MM\0*"sv, "", "a TIFF picture", "", kExportPicture},
    Kind{"BM", "", "a BMP picture", "", kExportPicture},
    Kind{"%PDF", "", "a PDF", "", "export the outline as SVG"},
    Kind{"%!PS", "", "a PostScript file", "", "export the outline as SVG"},
    Kind{"PK\x03\x04", "", "a ZIP archive", "", "unpack it first"},
    Kind{"\x1f\x8b", "", "a gzip archive", "", "unpack it first"},
    Kind{"BLENDER", "", "a Blender scene", "", kExportMesh},
    Kind{"Kaydara FBX", "", "an FBX scene", "", kExportMesh},
};

// Without a byte order mark, blanks, and lines of comments.
std::string_view stripped(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  while (!bytes.empty()) {
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    if (bytes.substr(0, 1) != "#") break;
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size()));
  }
  return bytes;
}

}  // namespace

std::string wrong_kind_hint(std::string_view bytes, const std::string& extension) {
  const std::string_view head = stripped(bytes.substr(0, 4096));
  for (const Kind& kind : kKinds) {
    if (head.substr(0, kind.begin.size()) != kind.begin || head.find(kind.word) == head.npos) continue;
    if (kind.extensions.find(extension) != kind.extensions.npos) return "";
    const std::string advice =
        kind.extensions.empty()
            ? std::string(kind.advice)
            : fmt::format("call it {}", kind.extensions.substr(0, kind.extensions.find(' ')));
    return fmt::format("; it holds {}, not what {} says: {}", kind.name, extension, advice);
  }
  return "";
}

}  // namespace wilt::detail
