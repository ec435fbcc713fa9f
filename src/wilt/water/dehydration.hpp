// How fast a cell loses water to the air.
#pragma once

namespace wilt {

/// Saturation vapour pressure over water in kPa; `celsius` in [-40, 60].
/// e_s = 0.61121 exp((18.678 - T/234.5) T / (257.14 + T)), Buck 1996. Throws Error{configuration} out of
/// range.
double saturation_vapour_pressure(double celsius);

/// VPD = e_s(T) (1 - H) in kPa; `humidity` is relative, in [0, 1]. Throws Error{configuration} out of range.
double vapour_pressure_deficit(double celsius, double humidity);

/// Where the rate of dehydration comes from.
enum class DehydrationRule {
  table,            ///< the paper's Table 1 as it stands, whatever the air is
  vapour_pressure,  ///< the table's rate x VPD(T, H) / VPD(20 C, 50 %)
  printed_product,  ///< the paper's equation 2, T H K with T in degrees Celsius (twice its own table)
};

struct DehydrationOptions {
  double celsius = 20.0;      ///< air temperature, [-40, 60]
  double humidity = 0.5;      ///< relative humidity of the air, [0, 1]
  double leaf_factor = 2e-3;  ///< K of Table 1, >= 0; read by printed_product only
  double table_rate = 0.01;   ///< w_loss of Table 1, working mass per working time, >= 0
  DehydrationRule rule = DehydrationRule::vapour_pressure;

  void validate() const;  ///< throws Error{configuration}
};

/// w_loss, working mass per cell and working time, >= 0. Throws Error{configuration} for bad options.
double dehydration_rate(const DehydrationOptions& options);

}  // namespace wilt
