// Seeded random numbers that are the same on every platform.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace wilt {

/// A stream of random numbers, fixed by a seed and the name of its purpose.
///
/// Two streams of one seed and different names are independent, so a new use of randomness never disturbs
/// an old one. std::mt19937_64 is specified by the standard; its distributions are not, so they are ours.
class Random {
 public:
  Random(std::uint64_t seed, std::string_view purpose);

  double uniform();                    ///< in [0, 1), 53 bits
  double uniform(double a, double b);  ///< in [a, b)
  double normal();                     ///< mean 0, variance 1 (Box-Muller)
  int index(int n);                    ///< in [0, n), n >= 1

 private:
  std::mt19937_64 engine_;
};

}  // namespace wilt
