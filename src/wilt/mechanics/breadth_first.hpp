// Numbering that keeps neighbours near (Cuthill and McKee 1969; internal).
#pragma once

#include <cstddef>
#include <vector>

namespace wilt::detail {

/// Appends `start` and all that can be reached from it to `order`, nearest first, and sets their `seen` to
/// `mark`; what bears that mark already is not entered. neighbours(v, visit) calls visit(w) for every
/// neighbour.
template <class Neighbours>
void append_breadth_first(int start, int mark, const Neighbours& neighbours, std::vector<int>& seen,
                          std::vector<int>& order) {
  seen[start] = mark;
  order.push_back(start);
  for (std::size_t k = order.size() - 1; k < order.size(); ++k) {
    neighbours(order[k], [&](int w) {
      if (seen[w] == mark) return;
      seen[w] = mark;
      order.push_back(w);
    });
  }
}

}  // namespace wilt::detail
