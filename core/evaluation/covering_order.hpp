#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace nextview {

/// Views in the order of a greedy set cover of what they see, the cover's own shuffled by the seed, then the others.
/// `seen_from`: for each view the numbers, below `samples`, of what it sees.
std::vector<std::size_t> covering_order(std::span<const std::vector<std::uint32_t>> seen_from, std::size_t samples,
                                        std::uint64_t seed);

}  // namespace nextview
