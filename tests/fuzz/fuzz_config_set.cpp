// Settings as `--set` takes them: a key=value a line, six at most. What they set lies in range, and is set
// again by what to_toml() writes.
#include "fuzz/config_checks.hpp"
#include "fuzz/contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  constexpr int kMostLines = 6;
  static const Config standard = default_config(species("maple"));
  Config config = standard;
  std::string_view text = fuzz::text_of(data, size);
  bool changed = false;
  for (int lines = 0; !text.empty() && lines < kMostLines; ++lines) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t equals = line.find('=');
    if (equals == line.npos) continue;
    const auto is_set = fuzz::unless_refused([&] {
      set(config, line.substr(0, equals), line.substr(equals + 1));
      return true;
    });
    changed = changed || is_set;
  }
  if (changed) fuzz::check_config(config, size % 2 == 0);
  return 0;
}
