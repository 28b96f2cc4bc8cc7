// OctoMap's .ot and .bt; a map that was read is written and read again as the same.
#include "core/map/octree_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const auto file = fuzzed_file("map.ot", {reinterpret_cast<const char*>(data), size});
  is_read([&] {
    const OccupancyMap map = read_octree(file);
    if (map.grid().voxel_count() > 4096) return;  // what follows takes its time
    const auto again = fuzzed_file("again.ot", "");
    write_octree(map, again);
    require(read_octree(again).grid().voxel_count() == map.grid().voxel_count(), "a map that was written is as large");
  });
  return 0;
}
