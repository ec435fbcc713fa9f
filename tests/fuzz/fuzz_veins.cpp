// A veins.json, drawn on a small leaf. What is accepted has distances for every vertex; veins as they were
// found give the veins that were found.
#include <string>

#include "fuzz/contract.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/veins_files.hpp"
#include "wilt/venation/venation.hpp"

namespace {

using namespace wilt;

struct Subject {
  Leaf leaf = make_leaf("willow", 200, 1);
  Venation found = find_venation(leaf, species("willow").secondary);
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Subject subject;
  const std::string text(fuzz::text_of(data, size));
  const auto drawn =
      fuzz::unless_refused([&] { return parse_veins_json(text, "veins.json", subject.leaf, subject.found); });
  if (!drawn) return 0;
  for (const DrawnVein& vein : *drawn) {
    fuzz::require(vein.found < static_cast<int>(subject.found.veins.size()),
                  "a known vein is one of those found");
    for (const SurfacePoint& point : vein.points)
      fuzz::require(int(point.face) >= 0 && int(point.face) < subject.leaf.mesh.num_faces() &&
                        point.barycentric.allFinite(),
                    "points lie on the blade");
  }
  if (drawn->size() > 20) return 0;
  const auto veins =
      fuzz::unless_refused([&] { return with_drawn_veins(subject.leaf, subject.found, *drawn); });
  if (!veins) return 0;
  fuzz::require(veins->vein_distance.size() == subject.leaf.mesh.num_vertices() &&
                    veins->vein_distance.allFinite() && veins->tip_distance.allFinite() &&
                    !veins->tips.empty(),
                "finite distances for every vertex");
  return 0;
}
