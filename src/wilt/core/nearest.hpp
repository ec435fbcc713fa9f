// "Did you mean": the known word nearest to one that is unknown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wilt {

/// The candidate with the smallest edit distance to `word`, or "" when none is near
/// (more than a third of the longer word's letters differ). O(#candidates * length^2).
std::string nearest_match(std::string_view word, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)", or "" when nothing is near: appended to messages.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace wilt
