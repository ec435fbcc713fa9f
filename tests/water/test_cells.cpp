// Mass, dehydration and pressure of single cells.
#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/water/dehydration.hpp"
#include "wilt/water/initial_mass.hpp"
#include "wilt/water/pressure.hpp"

namespace wilt {
namespace {

using Eigen::VectorXd;

// Oracle: analytic; the ends of the range and, for tau = 1, the middle.
TEST(InitialMass, FallsLinearlyFromTheVeinToTheFarthestCell) {
  VectorXd gd(3);
  gd << 0.0, 1.5, 3.0;
  const VectorXd m = initial_mass(gd, 3.0, {.m_min = 0.7, .m_max = 1.5, .tau = 1.0});
  EXPECT_DOUBLE_EQ(m[0], 1.5);
  EXPECT_DOUBLE_EQ(m[1], 1.1);
  EXPECT_DOUBLE_EQ(m[2], 0.7);
}

// Oracle: analytic; f = (1 - 3/4)^(1/2) = 1/2.
TEST(InitialMass, TauBendsTheFall) {
  const VectorXd m = initial_mass(VectorXd::Constant(1, 3.0), 4.0, {.m_min = 1.0, .m_max = 2.0, .tau = 0.5});
  EXPECT_NEAR(m[0], 1.5, 1e-15);
}

// Oracle: differential; equal maxima make the printed form the other one, and a vein alone takes m_max.
TEST(InitialMass, PrintedFormUsesEachVeinsOwnMaximum) {
  VectorXd gd(3), gd_max(3);
  gd << 1.0, 1.0, 0.0;
  gd_max << 2.0, 4.0, 0.0;
  const MassOptions options{.m_min = 0.8, .m_max = 1.0};
  const VectorXd m = initial_mass(gd, gd_max, options);
  EXPECT_EQ(m[0], initial_mass(gd.head(1), 2.0, options)[0]);
  EXPECT_EQ(m[1], initial_mass(gd.segment(1, 1), 4.0, options)[0]);
  EXPECT_EQ(m[2], 1.0);
}

// Oracle: negative.
TEST(InitialMass, RefusesBadInput) {
  EXPECT_THROW(initial_mass(VectorXd::Constant(1, 2.0), 1.0, {}), Error);
  EXPECT_THROW(initial_mass(VectorXd::Constant(1, -0.1), 1.0, {}), Error);
  EXPECT_THROW(initial_mass(VectorXd::Zero(1), 0.0, {}), Error);
  EXPECT_THROW(initial_mass(VectorXd::Zero(1), 1.0, {.m_min = 2.0, .m_max = 1.0}), Error);
  EXPECT_THROW(initial_mass(VectorXd::Zero(1), 1.0, {.tau = 0.0}), Error);
}

// Oracle: psychrometric tables (Buck 1996): 2.339 kPa at 20 C, 0.6112 at 0 C, 4.2452 at 30 C. The formula
// reproduces them to its stated 0.05 %, the tables' last digit.
TEST(VapourPressure, MatchesTheTables) {
  EXPECT_NEAR(saturation_vapour_pressure(20.0), 2.339, 1e-3);
  EXPECT_NEAR(saturation_vapour_pressure(0.0), 0.6112, 1e-4);
  EXPECT_NEAR(saturation_vapour_pressure(30.0), 4.245, 2e-3);
  EXPECT_NEAR(vapour_pressure_deficit(20.0, 0.5), 1.169, 1e-3);
  EXPECT_EQ(vapour_pressure_deficit(35.0, 1.0), 0.0);
}

// Oracle: the paper's Table 1, whose rates are half of T H K, and the definition of the default rule.
TEST(DehydrationRate, IsTheTablesAtTheTablesAir) {
  DehydrationOptions maple;
  EXPECT_DOUBLE_EQ(dehydration_rate(maple), 0.010);
  maple.rule = DehydrationRule::printed_product;
  EXPECT_DOUBLE_EQ(dehydration_rate(maple), 0.020);
  maple.rule = DehydrationRule::table;
  maple.celsius = 35.0;
  EXPECT_DOUBLE_EQ(dehydration_rate(maple), 0.010);
}

// Oracle: VPD is linear in 1 - H: twice as dry at 0 % as at 50 %, none at 100 %; the printed rate does the
// opposite.
TEST(DehydrationRate, DryAirDriesFaster) {
  EXPECT_DOUBLE_EQ(dehydration_rate({.humidity = 0.0}), 0.020);
  EXPECT_EQ(dehydration_rate({.humidity = 1.0}), 0.0);
  EXPECT_GT(dehydration_rate({.celsius = 30.0}), 0.018);
  const auto printed = [](double humidity) {
    return dehydration_rate({.humidity = humidity, .rule = DehydrationRule::printed_product});
  };
  EXPECT_LT(printed(0.2), printed(0.8));
}

// Oracle: negative.
TEST(DehydrationRate, RefusesAirThatCannotBe) {
  EXPECT_THROW(dehydration_rate({.humidity = 50.0}), Error);
  EXPECT_THROW(dehydration_rate({.celsius = 293.0}), Error);
  EXPECT_THROW(dehydration_rate({.table_rate = -1.0}), Error);
  EXPECT_THROW(dehydration_rate({.celsius = -5.0, .rule = DehydrationRule::printed_product}), Error);
}

// Oracle: analytic, E_v = 2e-4/0.002 = 0.1 and p' = 1 - 0.1 * 0.01/(0.8 * 0.1).
TEST(Pressure, PrintedAndRateFormAgreeAtThePapersStep) {
  for (const PressureForm form : {PressureForm::printed, PressureForm::rate}) {
    VectorXd p = VectorXd::Ones(1);
    update_pressure(p, VectorXd::Constant(1, 0.8), VectorXd::Constant(1, 0.01), 0.1, {.form = form});
    EXPECT_NEAR(p[0], 1.0 - 0.1 * 0.01 / 0.08, 1e-15);
  }
}

// Oracle: convergence; with constant water the rate form's total over a fixed time does not depend on the
// step, the printed form's grows as 1/dt^2.
TEST(Pressure, OnlyTheRateFormIsIndependentOfTheStep) {
  const auto total = [](PressureForm form, int steps) {
    VectorXd p = VectorXd::Zero(1);
    for (int k = 0; k < steps; ++k)
      update_pressure(p, VectorXd::Constant(1, 0.8), VectorXd::Constant(1, 0.01), 1.0 / steps,
                      {.form = form});
    return p[0];
  };
  EXPECT_NEAR(total(PressureForm::rate, 10), total(PressureForm::rate, 40), 1e-14);
  EXPECT_NEAR(total(PressureForm::printed, 40), 16.0 * total(PressureForm::printed, 10), 1e-12);
}

// Oracle: negative.
TEST(Pressure, RefusesDryCellsAndBadModuli) {
  VectorXd p = VectorXd::Zero(1);
  EXPECT_THROW(update_pressure(p, VectorXd::Zero(1), VectorXd::Zero(1), 0.1, {}), Error);
  EXPECT_THROW(update_pressure(p, VectorXd::Ones(1), VectorXd::Zero(1), 0.0, {}), Error);
  EXPECT_THROW(elastic_modulus({.poisson_ratio = 0.5}), Error);
}

}  // namespace
}  // namespace wilt
