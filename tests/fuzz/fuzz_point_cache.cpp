// The heads of PC2 and MDD point caches, as `wilt info` reads them.
#include <cmath>

#include "fuzz/contract.hpp"
#include "wilt/output/point_cache.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  const std::string_view bytes = fuzz::text_of(data, size);
  for (const char* name : {"leaf.pc2", "leaf.mdd"}) {
    if (const auto head = fuzz::unless_refused([&] { return parse_point_cache(bytes, name); })) {
      fuzz::require(head->points > 0 && head->frames > 0, "there are points and frames");
      fuzz::require(std::isfinite(head->length) && head->length >= 0.0, "the clip has a length");
      fuzz::require(12.0 * head->points * head->frames <= double(size), "the file holds what it says");
    }
  }
  return 0;
}
