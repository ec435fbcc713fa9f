// A checkpoint. The bytes are what stands between its first line and its hash, which are put around them: a
// fuzzer does not find hashes. What is read is the same when it is written and read again.
#include <fmt/format.h>

#include "fuzz/contract.hpp"
#include "wilt/core/hash.hpp"
#include "wilt/simulation/checkpoint.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  std::string bytes = "wilt checkpoint 1\n";
  bytes += fuzz::text_of(data, size);
  bytes += fmt::format("{:016x}\n", hash_bytes(bytes));
  const auto read = fuzz::unless_refused([&] { return parse_checkpoint(bytes, "run.checkpoint"); });
  if (!read) return 0;
  for (const auto& entry : read->arrays) fuzz::require(entry.second.allFinite(), "arrays are finite");
  const Checkpoint again = parse_checkpoint(checkpoint_bytes(*read), "again.checkpoint");
  fuzz::require(again.version == read->version && again.config == read->config && again.leaf == read->leaf &&
                    again.iteration == read->iteration && again.arrays == read->arrays,
                "the same checkpoint is read again");
  return 0;
}
