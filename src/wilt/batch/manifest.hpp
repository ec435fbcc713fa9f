// What is made of a batch when all of its items are there; for inside the batch room only.
#pragma once

#include <filesystem>
#include <vector>

#include "wilt/batch/batch.hpp"

namespace wilt {

/// Writes manifest.jsonl, SHA256SUMS, plan.toml and the layouts of the plan. `states`: whole or failed, of
/// every item. Throws Error{output}, Error{interrupted}.
void write_manifest(const Plan& plan, const std::filesystem::path& folder,
                    const std::vector<ItemState>& states, const Monitor& monitor);

}  // namespace wilt
