// One derivative test for all energies and forces, and the invariances that mechanics asks of them.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <functional>
#include <numbers>
#include <string>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mechanics/hinge_geometry.hpp"

namespace wilt {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_values;
using test::Sheet;

struct Named {
  std::string name;
  std::unique_ptr<Energy> energy;
  bool internal;  // invariant under rigid motion
};

// Every energy on a sheet, with random coefficients; the limits are set so that the states below exceed them.
std::vector<Named> all_energies(const Sheet& sheet, Random& random) {
  const int e = static_cast<int>(sheet.edges.rows()), n = static_cast<int>(sheet.positions.rows());
  const Stencil hinges = hinge_stencil(sheet.faces);
  const int h = static_cast<int>(hinges.rows());
  const VectorXd rest = test::lengths(sheet.edges, sheet.positions);
  std::vector<Named> all;
  all.push_back(
      {"springs", std::make_unique<Springs>(sheet.edges, rest, random_values(e, 1, 5, random)), true});
  all.push_back({"limit",
                 std::make_unique<StrainLimit>(sheet.edges, rest, random_values(e, 1, 9, random), 0.01),
                 true});
  all.push_back(
      {"tension", std::make_unique<LineTension>(sheet.edges, random_values(e, -1, 1, random)), true});
  all.push_back(
      {"area",
       std::make_unique<AreaLimit>(sheet.faces, sheet.positions,
                                   random_values(static_cast<int>(sheet.faces.rows()), 1, 2, random), 0.97),
       true});
  auto bending = std::make_unique<Hinges>(hinges, sheet.positions, random_values(h, 0.1, 1, random));
  bending->set_rest_angles(random_values(h, -0.5, 0.5, random));
  all.push_back({"hinges", std::move(bending), true});
  all.push_back(
      {"gravity", std::make_unique<Gravity>(random_values(n, 0, 1, random), Vec3(1, -2, 3)), false});
  return all;
}

// States: nearly flat, strongly deformed, crushed to a tenth in one direction (nearly degenerate triangles).
std::vector<Points3> states(const Sheet& sheet, Random& random) {
  const int n = static_cast<int>(sheet.positions.rows());
  std::vector<Points3> all;
  all.push_back(sheet.positions + test::random_points(n, 0.01, random));
  all.push_back(sheet.positions + test::random_points(n, 0.15, random));
  all.push_back(sheet.positions + test::random_points(n, 0.02, random));
  all.back().col(1) *= 0.1;
  return all;
}

Points3 gradient_of(const Energy& energy, const Points3& x) {
  Points3 g = Points3::Zero(x.rows(), 3);
  energy.add_gradient(x, g);
  return g;
}

MatrixXd hessian_of(Energy& energy, const Points3& x, Curvature curvature) {
  const auto pattern = std::make_shared<const BlockPattern>(static_cast<int>(x.rows()),
                                                            std::vector<Stencil>{energy.stencil()});
  energy.bind(*pattern);
  BlockMatrix matrix(pattern);
  energy.add_hessian(x, matrix, 1.0, curvature);
  return matrix.dense();
}

// Central differences of f in every coordinate; h^2 truncation and eps/h rounding balance at h = 1e-5 of the
// size.
MatrixXd differences(const Points3& x, const std::function<VectorXd(const Points3&)>& f) {
  const double h = 1e-5;
  MatrixXd columns;
  for (int k = 0; k < x.size(); ++k) {
    Points3 up = x, down = x;
    up.data()[k] += h;
    down.data()[k] -= h;
    const VectorXd slope = (f(up) - f(down)) / (2.0 * h);
    if (k == 0) columns.resize(slope.size(), x.size());
    columns.col(k) = slope;
  }
  return columns;
}

VectorXd flat(const Points3& x) {
  return Eigen::Map<const VectorXd>(x.data(), x.size());
}

// Oracle: finite difference. 1e-5 of the largest entry: h^2 times the third derivative over the first, of
// order (h/0.04)^2 on the crushed sheet, and some slack. The matrix of hinges is their Hessian where they are
// at rest.
TEST(Energies, GradientsAndHessiansAreTheDerivatives) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed, "derivatives");
    const Sheet sheet = test::sheet(3, 1.0, 0.1, seed);
    for (Named& term : all_energies(sheet, random)) {
      for (const Points3& x : states(sheet, random)) {
        SCOPED_TRACE(term.name);
        const VectorXd g = flat(gradient_of(*term.energy, x));
        const VectorXd g_fd = differences(x, [&](const Points3& y) {
                                return VectorXd::Constant(1, term.energy->energy(y));
                              }).transpose();
        EXPECT_LE((g - g_fd).cwiseAbs().maxCoeff(), 1e-5 * g.cwiseAbs().maxCoeff());
        if (auto* hinges = dynamic_cast<Hinges*>(term.energy.get()))
          hinges->set_rest_angles(hinges->angles(x));
        const MatrixXd hessian = hessian_of(*term.energy, x, Curvature::exact);
        const MatrixXd h_fd =
            differences(x, [&](const Points3& y) { return flat(gradient_of(*term.energy, y)); });
        const double size = std::max(hessian.cwiseAbs().maxCoeff(), 1.0);
        EXPECT_LT((hessian - h_fd).cwiseAbs().maxCoeff(), 1e-5 * size);
        EXPECT_LT((h_fd - h_fd.transpose()).cwiseAbs().maxCoeff(), 1e-5 * size);
      }
    }
  }
}

// Oracle: eigenvalues, to the single precision of the matrix; and where the exact Hessian is a sum of
// semi-definite parts, they agree: springs that are stretched, hinges at their rest angle.
TEST(Energies, SemidefiniteHessiansAreSoAndAgreeWhereTheyCan) {
  Random random(7, "semidefinite");
  const Sheet sheet = test::sheet(3, 1.0, 0.1, 7);
  for (Named& term : all_energies(sheet, random)) {
    SCOPED_TRACE(term.name);
    for (const Points3& x : states(sheet, random)) {
      const MatrixXd hessian = hessian_of(*term.energy, x, Curvature::semidefinite);
      const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(hessian).eigenvalues();
      EXPECT_GE(eigenvalues.minCoeff(), -1e-6 * std::max(eigenvalues.maxCoeff(), 1.0));
    }
  }
  const Stencil stencil = hinge_stencil(sheet.faces);
  Hinges hinges(stencil, sheet.positions, VectorXd::Ones(stencil.rows()));
  Springs springs(sheet.edges, test::lengths(sheet.edges, sheet.positions),
                  VectorXd::Ones(sheet.edges.rows()));
  const Points3 stretched = 1.3 * sheet.positions;
  for (const auto& [energy, x] :
       {std::pair<Energy*, Points3>(&hinges, sheet.positions), {&springs, stretched}}) {
    const MatrixXd exact = hessian_of(*energy, x, Curvature::exact);
    EXPECT_LT((exact - hessian_of(*energy, x, Curvature::semidefinite)).cwiseAbs().maxCoeff(),
              1e-12 * exact.cwiseAbs().maxCoeff());
  }
}

// Oracle: invariance; no change under a rotation and a shift, hence no net force and no net torque. Round-off
// scales with the shift of 10.
TEST(Energies, InternalOnesAreRigidlyInvariantAndBalanced) {
  Random random(11, "invariance");
  const Sheet sheet = test::sheet(4, 1.0, 0.2, 11);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  for (Named& term : all_energies(sheet, random)) {
    if (!term.internal) continue;
    SCOPED_TRACE(term.name);
    for (const Points3& x : states(sheet, random)) {
      const Points3 moved = (x * turn.transpose()).rowwise() + Eigen::RowVector3d(10, -5, 3);
      const double energy = term.energy->energy(x);
      EXPECT_NEAR(term.energy->energy(moved), energy, 1e-11 * std::max(std::abs(energy), 1.0));
      const Points3 g = gradient_of(*term.energy, x);
      Vec3 torque = Vec3::Zero();
      for (int i = 0; i < x.rows(); ++i)
        torque += Vec3(x.row(i).transpose()).cross(Vec3(g.row(i).transpose()));
      const double size = g.rowwise().norm().sum();
      EXPECT_LT(g.colwise().sum().norm(), 1e-14 * size);
      EXPECT_LT(torque.norm(), 1e-14 * size);
    }
  }
}

// Oracle: analytic; the hinge's own angle through the whole turn, up to 1e-6 of being shut, and its sign: the
// wings below the edge, seen from the upper side, make a ridge, which is positive.
TEST(Hinges, MeasureTheAngleThroughTheWholeTurn) {
  const double pi = std::numbers::pi;
  for (const double angle :
       {0.0, 1e-9, -1e-9, 1e-4, 0.5, -0.5, pi / 2, -pi / 2, 2.5, -3.0, pi - 1e-6, 1e-6 - pi}) {
    const double half = 0.5 * angle;
    const Vec3 e0(0, 0, 0), e1(2, 0, 0), left(0.7, std::cos(half), -std::sin(half)),
        right(1.1, -std::cos(half), -std::sin(half));
    EXPECT_NEAR(hinge_angle(e0, e1, left, right), angle, 1e-14 + 1e-15 * std::abs(angle)) << angle;
    EXPECT_NEAR(hinge_angle(e1, e0, right, left), angle, 1e-14 + 1e-15 * std::abs(angle)) << "turned round";
  }
  EXPECT_NEAR(hinge_angle({0, 0, 0}, {2, 0, 0}, {0.7, -1, 0}, {1.1, -1, 0}), pi, 1e-15) << "folded shut";
}

// Oracle: finite difference through the sweep; the gradient of the angle itself (k W = 1, theta_rest = theta
// - 1).
TEST(Hinges, HaveTheRightGradientAtEveryAngle) {
  const Stencil stencil = (Stencil(1, 4) << 0, 1, 2, 3).finished();
  for (const double angle : {0.0, 0.5, -0.5, 1.5, -2.5, 3.0, -3.0, 3.1, -3.1}) {
    const double half = 0.5 * angle;
    Points3 x(4, 3);
    x << 0, 0, 0, 2, 0, 0, 0.7, std::cos(half), -std::sin(half), 1.1, -std::cos(half), -std::sin(half);
    Hinges hinge(stencil, x, VectorXd::Ones(1));
    hinge.set_rest_angles(VectorXd::Constant(1, angle - 1.0));
    const VectorXd g = flat(gradient_of(hinge, x));
    const VectorXd g_fd =
        differences(x, [&](const Points3& y) { return VectorXd::Constant(1, hinge.energy(y)); }).transpose();
    EXPECT_LT((g - g_fd).cwiseAbs().maxCoeff(), 1e-7 * g.cwiseAbs().maxCoeff()) << angle;
  }
}

// Oracle: differential, against the scalar geometry hinge by hinge; round-off in double precision, and in
// single precision for the matrix. A count that leaves the last group of eight part empty.
TEST(Hinges, AreInGroupsOfEightWhatTheyAreAlone) {
  Random random(5, "groups");
  const Sheet sheet = test::sheet(5, 1.0, 0.1, 5);
  const Stencil stencil = hinge_stencil(sheet.faces);
  const int count = static_cast<int>(stencil.rows());
  ASSERT_NE(count % 8, 0);
  const VectorXd stiffness = random_values(count, 0.1, 1, random), rest = random_values(count, -1, 1, random);
  Hinges hinges(stencil, sheet.positions, stiffness);
  hinges.set_rest_angles(rest);
  const Points3 x = sheet.positions + test::random_points(36, 0.15, random);
  double energy = 0.0;
  VectorXd angles(count), gradient = VectorXd::Zero(108);
  MatrixXd matrix = MatrixXd::Zero(108, 108);
  for (int h = 0; h < count; ++h) {
    const auto corner = [&](int a) -> Vec3 { return x.row(stencil(h, a)).transpose(); };
    const auto hinge = detail::hinge_derivatives({corner(0), corner(1), corner(2), corner(3)});
    VectorXd slope = VectorXd::Zero(108);
    for (int a = 0; a < 4; ++a) slope.segment<3>(3 * stencil(h, a)) += hinge.gradient[a];
    const double k = stiffness[h] * hinges.weights()[h], bend = hinge.angle - rest[h];
    angles[h] = hinge.angle;
    energy += 0.5 * k * bend * bend;
    gradient += k * bend * slope;
    matrix += k * slope * slope.transpose();
  }
  EXPECT_LT((hinges.angles(x) - angles).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_NEAR(hinges.energy(x), energy, 1e-13 * energy);
  EXPECT_LT((flat(gradient_of(hinges, x)) - gradient).cwiseAbs().maxCoeff(),
            1e-13 * gradient.cwiseAbs().maxCoeff());
  EXPECT_LT((hessian_of(hinges, x, Curvature::exact) - matrix).cwiseAbs().maxCoeff(),
            1e-6 * matrix.cwiseAbs().maxCoeff());
}

// Oracle: a triangle without area has no normal, so the hinge at it has neither force nor energy; the others
// of its group keep theirs.
TEST(Hinges, BendFreelyAtATriangleWithoutArea) {
  Stencil stencil(2, 4);
  stencil << 0, 1, 2, 3, 4, 5, 6, 7;
  Points3 x(8, 3);
  x << 0, 0, 0, 2, 0, 0, 1, 0, 0, 1, -1, 0, 0, 0, 0, 2, 0, 0, 1, 1, 1, 1, -1, 0;
  Hinges hinges(stencil, x, VectorXd::Ones(2));
  hinges.set_rest_angles(VectorXd::Constant(2, 0.3));
  EXPECT_EQ(hinges.angles(x)[0], 0.0);
  EXPECT_GT(hinges.energy(x), 0.0);
  const Points3 g = gradient_of(hinges, x);
  EXPECT_EQ(g.topRows(4).norm(), 0.0);
  EXPECT_GT(g.bottomRows(4).norm(), 0.1);
}

// Oracle: the definition. Two right triangles with legs 1 on a diagonal: l^2 = 2, a = 1, W = 6; slivers clamp
// at 12; the energy follows, k/2 W theta^2.
TEST(Hinges, WeighByEdgeAndAreaAndClamp) {
  Points3 square(4, 3), sliver(4, 3);
  square << 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0;
  sliver << 0, 0, 0, 1, 0, 0, 0.5, 0.01, 0, 0.5, -0.01, 0;
  const Stencil stencil = (Stencil(1, 4) << 0, 1, 2, 3).finished();
  EXPECT_NEAR(Hinges(stencil, square, VectorXd::Ones(1)).weights()[0], 6.0, 1e-14);
  EXPECT_EQ(Hinges(stencil, sliver, VectorXd::Ones(1)).weights()[0], 12.0);
  Hinges hinge(stencil, square, VectorXd::Constant(1, 0.5));
  hinge.set_rest_angles(VectorXd::Constant(1, 0.2));
  EXPECT_NEAR(hinge.energy(square), 0.5 * 0.5 * 6.0 * 0.04, 1e-15);
}

// Oracle: the mesh's own counts; interior edges of a sheet are #E less the boundary's, each with its two
// faces.
TEST(Hinges, StencilHasEveryInteriorEdgeOnce) {
  const Sheet sheet = test::sheet(5, 1.0, 0.0, 1);
  const Stencil stencil = hinge_stencil(sheet.faces);
  EXPECT_EQ(stencil.rows(), sheet.edges.rows() - 20);
  Hinges hinges(stencil, sheet.positions, VectorXd::Ones(stencil.rows()));
  EXPECT_EQ(hinges.rest_angles().cwiseAbs().maxCoeff(), 0.0);
  Faces turned = sheet.faces;
  std::swap(turned(3, 1), turned(3, 2));
  EXPECT_THROW(hinge_stencil(turned), Error);
}

// Oracle: analytic; nothing below the threshold, 3 k L d^2 beyond it, in tension and compression.
TEST(StrainLimit, PushesBackOnlyBeyondItsThreshold) {
  const Edges edge = (Edges(1, 2) << 0, 1).finished();
  const StrainLimit limit(edge, VectorXd::Constant(1, 2.0), VectorXd::Constant(1, 5.0), 0.3);
  for (const double strain : {-0.5, -0.31, -0.29, 0.0, 0.29, 0.31, 0.6}) {
    const Points3 x = (Points3(2, 3) << 0, 0, 0, 2.0 * (1.0 + strain), 0, 0).finished();
    const double excess = std::max(std::abs(strain) - 0.3, 0.0);
    const double expected = 3.0 * 5.0 * 2.0 * excess * excess * (strain > 0 ? 1.0 : -1.0);
    EXPECT_NEAR(gradient_of(limit, x)(1, 0), expected, 1e-13) << strain;
  }
}

// Oracle: analytic; nothing above the threshold, k A (r_0/r - 1)^3 below it, without bound towards no area.
TEST(AreaLimit, KeepsATriangleFromCollapsing) {
  const Faces face = (Faces(1, 3) << 0, 1, 2).finished();
  Points3 x(3, 3);
  x << 0, 0, 0, 1, 0, 0, 0.3, 1, 0;
  const AreaLimit limit(face, x, VectorXd::Constant(1, 2.0), 0.5);
  for (const double ratio : {1.2, 0.6, 0.4, 0.1, 0.01}) {
    x(2, 1) = ratio;
    const double excess = std::max(0.5 / ratio - 1.0, 0.0);
    EXPECT_NEAR(limit.energy(x), 2.0 * 0.5 * excess * excess * excess,
                1e-12 * std::max(1.0, limit.energy(x)));
    EXPECT_EQ(gradient_of(limit, x)(2, 1) < 0.0, ratio < 0.5) << "it pushes the tip up";
  }
}

// Oracle: finite difference of the forces, symmetrised; for damping in v, for swelling in x.
TEST(Forces, JacobiansAreTheSymmetrisedDerivatives) {
  Random random(13, "forces");
  const Sheet sheet = test::sheet(3, 1.0, 0.1, 13);
  const int n = 16, e = static_cast<int>(sheet.edges.rows());
  const Points3 x = states(sheet, random)[1], v = test::random_points(n, 1.0, random);
  EdgeDamping damping(sheet.edges, random_values(e, 0.1, 1, random));
  Eigen::MatrixX2d c(e, 2);
  c << random_values(e, -1, 1, random), random_values(e, -1, 1, random);
  OneSidedSwelling swelling(sheet.edges, c);
  for (Force* force : {static_cast<Force*>(&damping), static_cast<Force*>(&swelling)}) {
    const auto pattern = std::make_shared<const BlockPattern>(n, std::vector<Stencil>{force->stencil()});
    force->bind(*pattern);
    BlockMatrix matrix(pattern);
    force->add_jacobian(x, v, matrix, 0.7, 0.3, Curvature::exact);
    const auto at = [&](const Points3& y, const Points3& u) {
      Points3 f = Points3::Zero(n, 3);
      force->add_force(y, u, f);
      return flat(f);
    };
    const MatrixXd by_x = differences(x, [&](const Points3& y) { return at(y, v); });
    const MatrixXd by_v = differences(v, [&](const Points3& u) { return at(x, u); });
    const MatrixXd expected = -0.7 * by_x - 0.3 * by_v;
    const MatrixXd symmetric = 0.5 * (expected + expected.transpose());
    EXPECT_LT((matrix.dense() - symmetric).cwiseAbs().maxCoeff(), 1e-7 * symmetric.cwiseAbs().maxCoeff());
  }
}

// Oracle: differential; with equal coefficients the printed swelling is minus the gradient of the line
// tension, balanced; with unequal ones its net force is the sum of the differences.
TEST(Forces, SwellingIsLineTensionWhenSymmetric) {
  Random random(17, "swelling");
  const Sheet sheet = test::sheet(4, 1.0, 0.1, 17);
  const int e = static_cast<int>(sheet.edges.rows());
  const VectorXd c = random_values(e, 0.1, 1, random);
  Eigen::MatrixX2d both(e, 2);
  both << c, c;
  const Points3& x = sheet.positions;
  Points3 force = Points3::Zero(x.rows(), 3);
  OneSidedSwelling(sheet.edges, both).add_force(x, force, force);
  EXPECT_LT((force + gradient_of(LineTension(sheet.edges, c), x)).cwiseAbs().maxCoeff(), 1e-14);

  both.col(1) *= 0.5;
  force.setZero();
  OneSidedSwelling(sheet.edges, both).add_force(x, force, force);
  EXPECT_GT(force.colwise().sum().norm(), 1e-3);
}

// Oracle: work; damping takes energy out whatever the velocities, and none from a rigid translation.
TEST(Forces, DampingTakesEnergyOut) {
  Random random(19, "damping");
  const Sheet sheet = test::sheet(4, 1.0, 0.1, 19);
  const EdgeDamping damping(sheet.edges, VectorXd::Constant(sheet.edges.rows(), 0.1));
  const Points3 v = test::random_points(25, 1.0, random);
  Points3 force = Points3::Zero(25, 3);
  damping.add_force(sheet.positions, v, force);
  EXPECT_LT(force.cwiseProduct(v).sum(), 0.0);
  force.setZero();
  damping.add_force(sheet.positions, Points3::Constant(25, 3, 0.7), force);
  EXPECT_EQ(force.cwiseAbs().maxCoeff(), 0.0);
}

// Oracle: negative; each message names the element.
TEST(Energies, RefuseBadInput) {
  const Edges edge = (Edges(1, 2) << 0, 1).finished();
  const VectorXd one = VectorXd::Ones(1), bad = VectorXd::Constant(1, -1.0), none(0);
  EXPECT_THROW(Springs(edge, bad, one), Error);
  EXPECT_THROW(Springs(edge, one, bad), Error);
  EXPECT_THROW(Springs(edge, none, one), Error);
  EXPECT_THROW(StrainLimit(edge, one, one, 1.0), Error);
  EXPECT_THROW(AreaLimit((Faces(1, 3) << 0, 1, 2).finished(), Points3::Zero(3, 3), one, 0.3), Error);
  EXPECT_THROW(LineTension(edge, VectorXd::Constant(1, NAN)), Error);
  EXPECT_THROW(EdgeDamping(edge, bad), Error);
  EXPECT_THROW(OneSidedSwelling(edge, Eigen::MatrixX2d::Zero(2, 2)), Error);
  EXPECT_THROW(Gravity(bad, Vec3::Zero()), Error);
  EXPECT_THROW(NodalForce(Points3::Constant(1, 3, INFINITY)), Error);
  try {
    Springs(edge, one, bad);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("spring 0 is -1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
