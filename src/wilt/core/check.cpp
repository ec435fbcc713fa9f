#include "wilt/core/check.hpp"

#include <stdexcept>

namespace wilt::detail {

void check_failed(const char* expression, const std::string& operands, const char* file, int line) {
  std::ostringstream out;
  out << "internal check failed: " << expression;
  if (!operands.empty()) out << " (operands: " << operands << ")";
  out << " at " << file << ":" << line << "; this is a bug in wilt, please report it";
  throw std::logic_error(out.str());
}

}  // namespace wilt::detail
