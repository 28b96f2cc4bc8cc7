#pragma once
#include <cstddef>
#include <functional>

namespace nextview {

using Nth = std::function<void(std::size_t)>;

/// For each i < count, in order: begin(i), then take(i), before which make(i) was called, by one of several threads a
/// few ahead: as many at a time as there are threads, but no more than eight, for what is made may be large. What
/// make(i) throws is thrown when it is i's turn: whatever the threads, the same failure is told of.
void make_ahead(std::size_t count, const Nth& begin, const Nth& make, const Nth& take);

}  // namespace nextview
