#include "wilt/simulation/external_force.hpp"

#include <array>
#include <cmath>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

using Row = std::array<double, 3>;

constexpr Row kUp{0, 0, .04};
constexpr std::array<std::array<Row, 7>, 6> kTable2 = {{
    {{kUp, kUp, {.01, .01, .04}, {.03, -.03, .03}, {-.02, .01, .04}, kUp, kUp}},                 // a
    {{kUp, kUp, {.01, .01, .04}, {0, -.03, -.03}, {-.02, .01, .04}, kUp, kUp}},                  // b
    {{{-.01, -.01, .04}, kUp, {.01, .01, .04}, {.03, -.03, .03}, {-.03, -.03, .06}, kUp, kUp}},  // c
    {{kUp,
      {.04, .04, .04},
      {-.01, -.01, .02},
      {.03, -.03, .03},
      {-.02, .01, .04},
      {-.04, 0, .06},
      kUp}},                                                                                  // d
    {{kUp, {0, .04, .04}, {.01, .01, .04}, {-.03, -.03, .03}, {-.02, .04, .04}, kUp, kUp}},   // e
    {{kUp, {0, .04, .04}, {.01, .01, .04}, {-.03, -.03, .03}, {-.02, -.03, .06}, kUp, kUp}},  // f
}};

}  // namespace

Points3 initial_tip_forces(int tips, const std::string& variant) {
  Points3 forces(tips, 3);
  WILT_CHECK(variant.size() == 1 && variant[0] >= 'a' && variant[0] <= 'f', variant);
  for (int r = 0; r < tips; ++r) {
    const Row& row = tips == 7 ? kTable2[variant[0] - 'a'][r] : kUp;
    forces.row(r) << row[0], row[1], row[2];
  }
  return forces;
}

ExternalForce::ExternalForce(const Points3& initial, const Eigen::MatrixXd& tip_distance, double range,
                             double growth)
    : tip_forces_(initial),
      rate_(growth * initial),
      reach_((-range * tip_distance.transpose()).array().exp().matrix()) {
  WILT_CHECK(initial.rows() == tip_distance.rows(), initial.rows(), tip_distance.rows());
}

}  // namespace wilt
