#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace nextview {

/// At most so many of them, in their order: what is left out lies evenly between those that are kept.
template <class T>
std::vector<T> evenly_kept(const std::vector<T>& all, std::size_t most) {
  std::vector<T> kept;
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t i = 0; i < count; ++i) kept.push_back(all[i * all.size() / count]);
  return kept;
}

}  // namespace nextview
