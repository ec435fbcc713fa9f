// Symbols: T air temperature (C), H relative humidity, K the leaf's factor, e_s saturation vapour pressure
// (kPa).
#include "wilt/water/dehydration.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr double kTableCelsius = 20.0;  // the air that Table 1 of the paper is for
constexpr double kTableHumidity = 0.5;

void require_rate(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value))
    throw Error(ErrorCode::configuration, fmt::format("{} is {}; it must be 0 or more", name, value));
}

}  // namespace

double saturation_vapour_pressure(double celsius) {
  if (!(celsius >= -40.0) || !(celsius <= 60.0))
    throw Error(ErrorCode::configuration,
                fmt::format("the temperature is {} C; it must lie between -40 and 60", celsius));
  return 0.61121 * std::exp((18.678 - celsius / 234.5) * celsius / (257.14 + celsius));
}

double vapour_pressure_deficit(double celsius, double humidity) {
  if (!(humidity >= 0.0) || !(humidity <= 1.0))
    throw Error(ErrorCode::configuration,
                fmt::format("the humidity is {}; it must lie between 0 and 1 (0.5 means 50 %)", humidity));
  return saturation_vapour_pressure(celsius) * (1.0 - humidity);
}

void DehydrationOptions::validate() const {
  vapour_pressure_deficit(celsius, humidity);
  require_rate("leaf_factor (K)", leaf_factor);
  require_rate("table_rate (w_loss)", table_rate);
  if (rule == DehydrationRule::printed_product && celsius < 0.0)
    throw Error(ErrorCode::configuration,
                fmt::format("the printed rate T H K is negative at {} C; use a temperature of 0 or more, or "
                            "another rule",
                            celsius));
}

double dehydration_rate(const DehydrationOptions& options) {
  options.validate();
  switch (options.rule) {
    case DehydrationRule::table:
      return options.table_rate;
    case DehydrationRule::vapour_pressure:
      return options.table_rate * vapour_pressure_deficit(options.celsius, options.humidity) /
             vapour_pressure_deficit(kTableCelsius, kTableHumidity);
    case DehydrationRule::printed_product:
      return options.celsius * options.humidity * options.leaf_factor;
  }
  throw Error(ErrorCode::configuration, "unknown rule of dehydration");
}

}  // namespace wilt
