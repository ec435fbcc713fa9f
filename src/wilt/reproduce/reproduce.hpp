// Every figure and table of the paper anew: pictures, plots, numbers, verdicts, one report.
#pragma once

#include <string>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/reproduce/claims.hpp"
#include "wilt/reproduce/pictures.hpp"

namespace wilt {

struct ReproduceOptions {
  int vertices = 2000;       ///< of every leaf, 200 to 1,000,000
  PictureSettings pictures;  ///< the seed also varies the leaves
  void validate() const;     ///< throws Error{configuration}
};

/// "table1", "table2", "fig2", "fig5" ... "fig15": in the order of the report.
const std::vector<std::string>& figure_names();

/// The figures that `words` name ("all" or nothing: all of them), each once, in the order of the report.
/// Throws Error{configuration} with the nearest name for an unknown one.
std::vector<std::string> chosen_figures(const std::vector<std::string>& words);

/// Makes `figures` in `folder`, which is created: index.html, claims.csv, and the pictures and plots (SVG,
/// with the CSV and the gnuplot script of each). Returns the claims.
///
/// One stage of the monitor per figure. When the user asks to stop, the report of the figures that are done
/// is written and Error{interrupted} thrown. Deterministic: the bytes of CSV files do not depend on the
/// number of threads. Throws Error{output}, before the work, when `folder` cannot be written or gnuplot is
/// missing.
std::vector<Claim> reproduce(const std::vector<std::string>& figures, const std::string& folder,
                             const ReproduceOptions& options, const Monitor& monitor = {});

}  // namespace wilt
