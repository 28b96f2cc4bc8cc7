// What one scan tells, as OctoMap has it and as the Gibbs sampler does. Usage: map CLOUD X Y Z (of the camera)
#include <cstdio>
#include <exception>
#include <string>

#include "core/gibbs/posterior_sampler.hpp"
#include "core/map/octree_file.hpp"
using namespace nextview;

int main(int, char** argv) try {
  Scan scan{.origin = {std::stod(argv[2]), std::stod(argv[3]), std::stod(argv[4])}, .max_range = 1.5};  // [m, world]
  scan.hits = read_ply(argv[1]);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : scan.hits) box.extend(point.cast<double>());
  const VoxelGrid grid = region_of_interest(box, box.sizes().maxCoeff() / 50.0);

  OccupancyMap map(grid);
  map.insert(scan);
  write_octree(map, "map.ot");
  const GibbsPosterior posterior = sample_posterior(grid, measurements_of({&scan, 1}), {});
  int occupied = 0, surface = 0;
  for (std::uint32_t voxel = 0; voxel < grid.voxel_count(); ++voxel) {
    occupied += map.log_odds(voxel) > 0.0f;
    surface += posterior.informed[voxel] && posterior.touch[voxel] > 0.5f;
  }
  std::printf("%d voxels are occupied, %d are likely to hold surface\n", occupied, surface);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
