// A plan. Its items are configurations in range, the same ones when it is read again.
#include <algorithm>

#include "fuzz/config_checks.hpp"
#include "fuzz/contract.hpp"
#include "wilt/batch/plan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  const std::string_view toml = fuzz::text_of(data, size);
  if (toml.find_first_of("*?") != toml.npos) return 0;  // patterns ask the file system
  const auto read = [&] { return Plan(toml, "plan.toml", "folder"); };
  const std::optional<Plan> plan = fuzz::unless_refused(read);
  if (!plan) return 0;
  fuzz::require(plan->count() >= 1, "a plan has an item");
  for (const int number : {0, plan->count() / 2, plan->count() - 1}) {
    const Item item = plan->item(number);
    fuzz::check_config(item.config, false);
    fuzz::require(to_json(read().item(number).config) == to_json(item.config), "an item is always the same");
  }
  return 0;
}
