// Lists of indices, one per owner, in one array.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace wilt {

/// What gathers from where: list i holds the indices that were paired with owner i, in the order given.
class IndexLists {
 public:
  IndexLists() = default;

  /// `pairs` of owner, in [0, owner_count), and index.
  IndexLists(int owner_count, const std::vector<std::pair<int, int>>& pairs)
      : begin_(owner_count + 1, 0), indices_(pairs.size()) {
    for (const auto& [owner, index] : pairs) ++begin_[owner + 1];
    for (int i = 0; i < owner_count; ++i) begin_[i + 1] += begin_[i];
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (const auto& [owner, index] : pairs) indices_[next[owner]++] = index;
  }

  std::span<const int> operator[](int owner) const {
    return {indices_.data() + begin_[owner], indices_.data() + begin_[owner + 1]};
  }

 private:
  std::vector<int> begin_, indices_;
};

}  // namespace wilt
