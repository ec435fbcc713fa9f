// Work that may crash, in a process of its own. Inside the import room only.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "wilt/core/monitor.hpp"

namespace wilt::detail {

struct IsolationLimits {
  std::uint64_t memory = std::uint64_t{8} << 30;  ///< bytes of addresses beyond what the process has already
  int cpu_seconds = 120;                          ///< of processor time
  int seconds = 300;                              ///< of the clock
};

/// Runs `work` in a forked child and returns its bytes; an Error that it throws is thrown here. A crash, a
/// limit reached and any other exception become Error{input} that begin with `reader` ("the mesh reader").
/// Throws Error{interrupted} when the monitor says so; in every case the child is gone when this returns.
///
/// Other threads may run: the child has a copy of the calling one alone. So `work` must start no thread, use
/// no lock that another thread may hold (memory allocation, exceptions and functions of the C library are
/// safe with glibc), write no file and print nothing: its standard output and error lead nowhere. Under
/// sanitizers, which reserve addresses and print what they find, memory and printing are not limited.
std::string run_isolated(const std::string& reader, const std::function<std::string()>& work,
                         const Monitor& monitor = {}, const IsolationLimits& limits = {});

}  // namespace wilt::detail
