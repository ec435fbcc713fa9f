#include <algorithm>

#include "wilt/core/parallel.hpp"

namespace wilt {

void parallel_for(int count, int /*grain*/, const std::function<void(int, int)>& body) {
  if (count > 0) body(0, count);
}

double parallel_sum(int count, int block, const std::function<double(int, int)>& block_sum) {
  double sum = 0.0;
  for (int begin = 0; begin < count; begin += block) sum += block_sum(begin, std::min(count, begin + block));
  return sum;
}

struct Crew::Impl {};
Crew::Crew() = default;
Crew::~Crew() = default;
void Crew::for_each(int count, const std::function<void(int)>& body) {
  for (int i = 0; i < count; ++i) body(i);
}

struct ThreadLimit::Impl {};
ThreadLimit::ThreadLimit(int) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace wilt
