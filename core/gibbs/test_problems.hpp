#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// A map small enough to add up all of its states, with measurements that show where independent voxels go wrong.
struct TestProblem {
  std::string_view name;
  std::string_view summary;
  std::string_view look_at;  ///< two lines: which voxels tell the story
  VoxelGrid grid;
  double sigma = 0.0;  ///< noise of its ranges [m]
  std::vector<Scan> scans;
};

std::span<const TestProblem> test_problems();

/// @throws std::invalid_argument naming the test problems that there are.
const TestProblem& test_problem(std::string_view name);

}  // namespace nextview
