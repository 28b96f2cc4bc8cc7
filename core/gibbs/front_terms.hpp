#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/gibbs/ray_lists.hpp"

namespace nextview {

/// What a chain knows of a ray, see SurvivalState: what is asked for whenever a voxel in front is looked at, ...
struct alignas(8) RayWitness {
  float s;         ///< T S
  float evidence;  ///< RayLists::evidence
};
/// ... and what s is made of.
struct alignas(8) RaySurvival {
  float near_sum = 0.0f;   ///< S
  std::int32_t depth = 0;  ///< optical depth of the voxels in front, which T is of
};

/// One for each code of a chord.
template <class T>
using OfChords = std::array<T, RayLists::chord_codes>;
/// What passes voxels of two levels; side by side, as both are asked for together.
struct alignas(8) PassingPair : std::array<float, 2> {};

/// A voxel in front of rays' ranges, and what they say of it.
struct FrontTerms {
  std::span<const RayLists::FrontEntry> entries;   ///< RayLists::front of a voxel
  const RayWitness* rays;                          ///< by number, all of them
  const RaySurvival* survivals;                    ///< likewise
  std::span<const OfChords<PassingPair>> passing;  ///< a voxel of levels 1 and 2, 3 and 4, …
  const OfChords<std::int32_t>* own_depth;         ///< of the voxel as it is now; null: it is free

  static constexpr std::size_t block = 16;  ///< rays that are looked at together
  static_assert(block <= RayLists::entries_beyond + 1);
};

/// Adds the terms of Eq. 8, log p(z | m with q) - log p(z | m with 0), to log_weights[q - 1] for each level q >= 1.
/// They are at most 0, as a voxel in front can only block: once no weight reaches `enough`, the sum stops, and true is
/// returned. The same bits on any instruction set.
bool add_front_terms(const FrontTerms& terms, double enough, std::span<double> log_weights);

}  // namespace nextview
