// The orientation that a JPEG's EXIF states.
#include "fuzz/contract.hpp"
#include "wilt/import/photo_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int orientation = wilt::detail::exif_orientation(wilt::fuzz::text_of(data, size));
  wilt::fuzz::require(orientation >= 1 && orientation <= 8, "an orientation is one of eight");
  return 0;
}
