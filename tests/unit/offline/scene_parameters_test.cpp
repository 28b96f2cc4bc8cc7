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
}

/// 2^15 voxels each way, whatever their size.
TEST(SceneParameters, ViewsLieWhereAnOctreeReaches) {
  for (const double resolution : {0.1, 0.01}) {
    const double reach = 32768 * resolution;
    EXPECT_NO_THROW(scene_parameters(scene_from({0, 0.999 * reach, 0}, resolution))) << resolution;
    EXPECT_THROW(scene_parameters(scene_from({0, -1.001 * reach, 0}, resolution)), std::invalid_argument) << resolution;
  }
}

}  // namespace
}  // namespace nextview
