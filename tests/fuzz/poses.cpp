// Poses, intrinsics, projections and views, each format reading what may be meant for another.
#include "core/recording/pose_files.hpp"
#include "core/view/candidate_views.hpp"
#include "core/view/projection_matrix.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const auto file = fuzzed_file("poses.txt", {reinterpret_cast<const char*>(data), size});
  for (const PoseFormat format : {PoseFormat::matrix4x4, PoseFormat::quaternion_xyzw, PoseFormat::quaternion_wxyz,
                                  PoseFormat::tum, PoseFormat::conf})
    is_read([&] {
      for (const NamedPose& named : read_poses(file, format, PoseDirection::world_to_sensor, PoseAxes::body))
        if (named.fault.empty() && !named.is_unknown)
          require(is_pose(*named.pose()), "what is neither unknown nor a fault is a pose");
    });
  is_read([&] { read_intrinsics(file); });
  is_read([&] { read_projections(file); });
  is_read([&] {
    for (const Pose& pose : read_views(file)) require(is_pose(pose), "a view is a pose");
  });
  return 0;
}
