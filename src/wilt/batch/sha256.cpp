#include "wilt/batch/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "wilt/core/check.hpp"

namespace wilt {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  const int done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  WILT_CHECK(done == 1, bytes.size());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace wilt
