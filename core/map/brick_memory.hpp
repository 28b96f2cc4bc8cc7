#pragma once
#include <array>
#include <cstdint>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// What was found of the bricks, or pairs of them, that were met last: many places share one.
template <class Value>
class BrickMemory {
 public:
  using Brick = VoxelBricks::Brick;
  /// `find()`, if it was not found already. All bricks that are asked about must live as long as this.
  template <class Find>
  Value of(const Brick& a, const Brick& b, Find find) {
    Known& known = known_[(address(a) * 3 + address(b)) * 0x9e3779b97f4a7c15u >> (64 - 6)];
    if (known.a != &a || known.b != &b) known = {&a, &b, find()};
    return known.value;
  }
  template <class Find>
  Value of(const Brick& brick, Find find) {
    return of(brick, brick, find);
  }

 private:
  static std::uint64_t address(const Brick& brick) { return reinterpret_cast<std::uintptr_t>(&brick); }
  struct Known {
    const Brick *a = nullptr, *b = nullptr;
    Value value{};
  };
  std::array<Known, 64> known_{};
};

}  // namespace nextview
