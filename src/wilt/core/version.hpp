// The version that stands in every result.
#pragma once

namespace wilt {

/// "0.1.0": the version of the CMake project.
const char* version();

}  // namespace wilt
