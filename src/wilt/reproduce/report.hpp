// The report: one page that a reviewer can read, beside the files that it shows.
#pragma once

#include <string>
#include <vector>

#include "wilt/reproduce/figure.hpp"

namespace wilt {

struct ReportFacts {
  int vertices = 2000;             ///< of every leaf
  unsigned long seed = 1;          ///< of every leaf
  std::vector<std::string> notes;  ///< runs that stopped early, an interruption
};

/// index.html: claims at the top, a section per figure. Well-formed XML, no scripts, links are relative.
std::string report_html(const std::vector<Figure>& figures, const ReportFacts& facts);

}  // namespace wilt
