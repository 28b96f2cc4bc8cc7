#include "core/offline/scene_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RecordedScene scene_from(const Vector3& position, double resolution) {
  RecordedScene scene;
  scene.parameters = {{"resolution_m", resolution}};
  scene.views = {make_pose(position, Eigen::Quaterniond::Identity())};
  return scene;
}

std::vector<std::string> warnings_of(const RecordedScene& scene) {
  std::vector<std::string> warnings;
  scene_parameters(scene, [&](const std::string& warning) { warnings.push_back(warning); });
  return warnings;
}

TEST(SceneParameters, OnlyWhatHasNoMeaningIsWarnedOf) {
  RecordedScene scene = scene_from({0, 0, 1}, 0.1);
  scene.parameters["voxels_in_void_ray"] = 7;  // of the reference code, where it does nothing
  EXPECT_THAT(warnings_of(scene), IsEmpty());
  scene.parameters["colour"] = 7;
  EXPECT_THAT(warnings_of(scene), ElementsAre(HasSubstr("parameter colour has no meaning here")));
  scene.parameters = {{"resolutoin_m", 0.1}};
  EXPECT_THAT(warnings_of(scene), ElementsAre(HasSubstr("did you mean 'resolution_m'?")));
}

/// 2^15 voxels each way, whatever their size.
TEST(SceneParameters, ViewsLieWhereAnOctreeReaches) {
  for (const double resolution : {0.1, 0.01}) {
    const double reach = 32768 * resolution;
    EXPECT_NO_THROW(scene_parameters(scene_from({0, 0.999 * reach, 0}, resolution))) << resolution;
    EXPECT_THROW(scene_parameters(scene_from({0, -1.001 * reach, 0}, resolution)), std::invalid_argument) << resolution;
  }
}

RecordedScene scene_of_box(double resolution, const Vector3& lower, const Vector3& upper) {
  RecordedScene scene = scene_from({0, 0, 0}, resolution);
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    scene.parameters[std::string("bbox_min_") + axes[axis] + "_m"] = lower[axis];
    scene.parameters[std::string("bbox_max_") + axes[axis] + "_m"] = upper[axis];
  }
  return scene;
}

TEST(SceneParameters, TheGridHoldsTheBoundingBox) {
  const VoxelGrid grid = scene_parameters(scene_of_box(0.1, {-0.35, 0.15, -1.05}, {0.75, 0.25, -0.95})).grid();
  EXPECT_EQ(grid.resolution, 0.1);
  EXPECT_EQ(grid.first, Eigen::Vector3i(-4, 1, -11)) << "whole voxels, from below the box";
  EXPECT_EQ(grid.size, Eigen::Vector3i(12, 2, 2)) << "to above it";
  for (const double other : {0.75, -0.4})  // no box is empty
    EXPECT_THROW(scene_parameters(scene_of_box(0.1, {0.75, 0, 0}, {other, 1, 1})), std::invalid_argument) << other;
}

// 2^28, whatever their size.
TEST(SceneParameters, AGridHasAtMost268MillionVoxels) {
  const auto grid_up_to = [](double x) {
    return scene_parameters(scene_of_box(0.25, {-128, -64, -64}, {x, 64, 64})).grid();
  };
  EXPECT_EQ(grid_up_to(128.0).voxel_count(), 268'435'456u);
  try {
    grid_up_to(128.25);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("the bounding box holds 268697600 voxels; at most 268435456 are held: let them "
                                        "be larger (parameter resolution_m; of range scans --voxel)"));
  }
}

}  // namespace
}  // namespace nextview
