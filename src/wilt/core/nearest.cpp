#include "wilt/core/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace wilt {
namespace {

// Levenshtein distance with adjacent transpositions counted as one edit (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b) {
  const int columns = static_cast<int>(b.size()) + 1;
  std::vector<int> before(columns), previous(columns), current(columns);
  std::iota(previous.begin(), previous.end(), 0);
  for (int i = 1; i <= static_cast<int>(a.size()); ++i) {
    current[0] = i;
    for (int j = 1; j < columns; ++j) {
      const int substitution = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[columns - 1];
}

}  // namespace

std::string nearest_match(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  int best_distance = 0;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    const int limit = static_cast<int>(std::max(word.size(), candidate.size()) + 2) / 3;
    if (distance <= limit && (best.empty() || distance < best_distance)) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string match = nearest_match(word, candidates);
  return match.empty() ? "" : " (did you mean '" + match + "'?)";
}

}  // namespace wilt
