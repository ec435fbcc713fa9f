#include "wilt/import/surface_petiole.hpp"

#include <fmt/format.h>

#include "wilt/leaf/petiole.hpp"

namespace wilt::detail {

int given_petiole(const Points3& margin, const Vec3& normal, const Vec2& wanted,
                  std::vector<std::string>& notes) {
  int left_out = 0;
  normal.cwiseAbs().maxCoeff(&left_out);
  const int first = left_out == 0 ? 1 : 0, second = left_out == 2 ? 1 : 2;
  int best = 0;
  double least = 1e300;
  for (int i = 0; i < margin.rows(); ++i) {
    const double distance = (Vec2(margin(i, first), margin(i, second)) - wanted).norm();
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  const Vec3 p = margin.row(best).transpose();
  notes.push_back(fmt::format(
      "petiole as given: the margin vertex at ({:.4g}, {:.4g}, {:.4g}), {:.3g} from {},{} = ({:.4g}, {:.4g})",
      p.x(), p.y(), p.z(), least, "xyz"[first], "xyz"[second], wanted.x(), wanted.y()));
  return best;
}

int guessed_petiole(const Points2& flat, const Points3& margin, std::vector<std::string>& notes) {
  const PetioleGuess guess = find_petiole(flat);
  const Vec3 p = margin.row(guess.index).transpose();
  notes.push_back(fmt::format("petiole found at ({:.4g}, {:.4g}, {:.4g}): {} (confidence {:.0f} %){}", p.x(),
                              p.y(), p.z(), guess.reason, 100 * guess.confidence,
                              guess.confidence < 0.5 ? "; if that is wrong give --petiole X,Y" : ""));
  return guess.index;
}

void place_stalk(Leaf& leaf, const Points3& centreline, const std::vector<double>& radii) {
  const Placement& placement = leaf.placement;
  leaf.stalk.centreline =
      (centreline.rowwise() - placement.translation.transpose()) * placement.rotation / placement.scale;
  leaf.stalk.centreline.row(0) = leaf.positions.row(leaf.petiole);
  leaf.stalk.radii.clear();
  for (const double radius : radii) leaf.stalk.radii.push_back(radius / placement.scale);
}

}  // namespace wilt::detail
