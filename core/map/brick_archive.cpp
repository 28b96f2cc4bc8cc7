#include "core/map/brick_archive.hpp"

#include <bit>
#include <map>
#include <utility>

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

/// Which bricks hold anything, and which of the different ones each of them is.
struct Kept {
  std::vector<std::uint32_t> places, which;
  std::vector<const Brick*> different;
};

Kept kept_bricks(const VoxelBricks& voxels) {
  Kept kept;
  std::map<std::pair<std::uint32_t, std::uint8_t>, std::uint32_t> uniform;
  const auto bricks = voxels.bricks();
  for (std::uint32_t b = 0; b < bricks.size(); ++b) {
    const Brick& brick = *bricks[b];
    if (voxels.is_untouched(b) || brick.holds_nothing()) continue;
    std::uint32_t which = static_cast<std::uint32_t>(kept.different.size());
    if (brick.is_uniform())
      which = uniform.try_emplace({std::bit_cast<std::uint32_t>(brick.numbers()[0]), brick.states()[0]}, which)
                  .first->second;
    if (which == kept.different.size()) kept.different.push_back(&brick);
    kept.places.push_back(b);
    kept.which.push_back(which);
  }
  return kept;
}

}  // namespace

void write_bricks(ByteWriter& writer, const VoxelBricks& voxels) {
  const Kept kept = kept_bricks(voxels);
  writer(kept.places, kept.which, std::uint64_t{kept.different.size()});
  for (const Brick* const brick : kept.different) writer(brick->numbers(), brick->states());
}

void read_bricks(ByteReader& reader, OccupancyMap& map) {
  std::vector<std::uint32_t> places, which;
  std::uint64_t count = 0;
  reader(places, which, count);
  const auto bricks = map.change_bricks();
  if (places.size() != which.size() || count > places.size()) throw std::runtime_error("they are no bricks");
  std::vector<CopyOnWrite<Brick>> different(count);
  for (CopyOnWrite<Brick>& brick : different) {
    std::array<float, VoxelBricks::brick_voxels> numbers;
    std::array<std::uint8_t, VoxelBricks::brick_voxels> states;
    reader(numbers, states);
    brick.change().set(numbers, states);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] >= bricks.size() || which[k] >= count) throw std::runtime_error("no such brick");
    bricks[places[k]] = different[which[k]];
  }
}

}  // namespace nextview
