// Weak stand-ins for what other rooms' sources define.
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

__attribute__((weak)) double leaf_length(const Leaf& leaf) {
  const Vec3 petiole = leaf.positions.row(leaf.petiole);
  return (leaf.positions.rowwise() - petiole.transpose()).rowwise().norm().maxCoeff();
}

__attribute__((weak)) const char* region_name(Region region) {
  switch (region) {
    case Region::tip:
      return "tip";
    case Region::vein:
      return "vein";
    case Region::margin:
      return "margin";
    case Region::mesophyll:
      return "mesophyll";
  }
  return "";
}

}  // namespace wilt
