#pragma once
#include <cstdint>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// A part that nobody needs, to learn from: boxes, cylinders, balls and rings joined at random, with ribs and bosses on
/// them and bores, slots and pockets cut out. Watertight, longest side 0.5 m, centred in the origin. The same number
/// and seed give the same part.
TriangleMesh training_part(std::uint32_t number, std::uint64_t seed);

/// One with rings and rows of small things, narrow grooves and thin walls, down to a few millimetres: what bolt
/// circles, fins, gears and bearings are like. About 0.5 m long; half of them have walls on multiples of 5 mm. Pieces
/// may be loose.
TriangleMesh detailed_training_part(std::uint32_t number, std::uint64_t seed);

}  // namespace nextview
