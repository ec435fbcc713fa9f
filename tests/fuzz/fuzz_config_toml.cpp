// A configuration file. What it sets lies in range, and is set again by what to_toml() writes.
#include "fuzz/config_checks.hpp"
#include "fuzz/contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  static const Config standard = default_config(species("maple"));
  const std::string_view toml = fuzz::text_of(data, size);
  Config config = standard;
  const auto applied = fuzz::unless_refused([&] {
    apply_toml(config, toml, "run.toml");
    return true;
  });
  if (applied) {
    resolve_config("maple", toml, "run.toml", {});
    fuzz::check_config(config, size % 2 == 0);
  }
  return 0;
}
