#include "wilt/core/version.hpp"

namespace wilt {

const char* version() {
  return WILT_VERSION;
}

}  // namespace wilt
