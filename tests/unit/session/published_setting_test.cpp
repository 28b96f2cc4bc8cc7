#include <gmock/gmock.h>

#include <cmath>

#include "core/session/session_parts.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// The box stands on the ground of an off-centre region that is no cube.
Configuration standing() {
  Configuration c = small_scan();
  c.object.ground = true;
  c.map.region = "-0.8 -0.6 -0.32 0.8 0.6 0.48";
  c.views.layout = ViewLayout::hemisphere;
  return c;
}

TEST(PublishedSetting, TheGroundIsSeenAndMappedButNotCovered) {
  Configuration without = standing();
  without.object.ground = false;
  Session on_ground(standing()), in_air(without);
  finish(on_ground);
  finish(in_air);
  const double lowest = on_ground.mesh()->bounding_box().min().z();
  const auto occupied_beside = [&](const Session& session) {
    const VoxelGrid& grid = session.map().grid();
    const Voxel& voxel = session.map().voxels()[grid.index(grid.cell_at({0.5, 0.4, lowest}))];
    return voxel.measured && voxel.probability > 0.5f;
  };
  EXPECT_TRUE(occupied_beside(on_ground));
  EXPECT_FALSE(occupied_beside(in_air));
  EXPECT_GT(on_ground.records().front().hits, in_air.records().front().hits);
  // The same surface is counted, from samples of the object alone.
  const KnownObject& known = *on_ground.known_object();
  EXPECT_EQ(known.samples().points, in_air.known_object()->samples().points);
  // The ground is true, and the object stays what is inside.
  const GroundTruth &truth = known.truth(), &bare = in_air.known_object()->truth();
  EXPECT_EQ(truth.centre, bare.centre);
  EXPECT_TRUE(truth.touch[truth.grid.index(truth.grid.cell_at({0.5, 0.4, lowest}))]);
}

TEST(PublishedSetting, TheRegionIsTheBox) {
  const VoxelGrid grid = configured_region(standing());
  EXPECT_EQ(grid.first, Eigen::Vector3i(-20, -15, -8));
  EXPECT_EQ(grid.size, Eigen::Vector3i(40, 30, 20));
  EXPECT_LT((view_target(standing()) - Vector3(0, 0, 0.08)).norm(), 1e-12);
  EXPECT_EQ(view_target(small_scan()), Vector3::Zero());
  const Pose start = configured_start_view(standing());
  EXPECT_LT((start.translation() - view_target(standing())).cross(start.linear().col(2)).norm(), 1e-9);
}

TEST(PublishedSetting, AnObjectBeyondTheBoxIsAnErrorWithAdvice) {
  Configuration c = standing();
  c.map.region = "-0.8 -0.6 0 0.8 0.6 0.8";
  try {
    const Session session(c);
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("box.ply"), testing::HasSubstr("map.region"),
                                             testing::HasSubstr("object.centred")));
  }
}

TEST(PublishedSetting, TheFirstViewMayBeAPose) {
  Configuration c = small_scan();
  c.planner.start_view = "-0.9 0 0.1 0 -0.70710678 0 -0.70710678";
  Session session(c);
  session.step();
  EXPECT_EQ(session.records().front().T_world_camera.matrix(), parse_view(c.planner.start_view).matrix());
}

TEST(PublishedSetting, CoverageOfVerticesIsAShareOfAllOfThem) {
  Configuration c = small_scan();
  c.evaluation.samples = EvaluationSamples::vertices;
  Session session(c);
  finish(session);
  const std::vector<Eigen::Vector3f>& vertices = session.known_object()->samples().points;
  EXPECT_EQ(vertices, vertex_samples(*session.mesh()).points);
  std::size_t near = 0;
  for (const Eigen::Vector3f& vertex : vertices)
    near += std::ranges::any_of(session.scans(), [&](const auto& scan) {
      return std::ranges::any_of(scan->hits, [&](const Eigen::Vector3f& hit) {
        return (hit - vertex).cast<double>().norm() <= c.evaluation.d_reg;
      });
    });
  EXPECT_NEAR(session.records().back().coverage, double(near) / double(vertices.size()), 1e-12);
}

TEST(PublishedSetting, RaysGoThroughTheWindow) {
  Configuration c = small_scan();
  const PinholeCamera camera = c.sensor.camera();
  EXPECT_EQ(scoring_rays(c, camera).directions, RayBundle::regular(camera, 12, 9).directions);
  c.planner.ray_window = 0.5;
  EXPECT_EQ(scoring_rays(c, camera).directions, RayBundle::regular(camera, 12, 9, 0.5).directions);
}

TEST(FinerRays, AreNoMoreThanPixels) {
  Configuration c;
  c.planner.ray_columns = 12, c.planner.ray_rows = 9;
  const auto times = [&](int width, int height) {
    c.sensor.width = width, c.sensor.height = height;
    const std::size_t rays = finer_rays(c, c.sensor.camera()).directions.size();
    return std::sqrt(double(rays) / (12 * 9));
  };
  EXPECT_EQ(times(480, 360), 4.0);
  EXPECT_EQ(times(480, 30), 3.0) << "as few rows of pixels";
  EXPECT_EQ(times(23, 400), 0.0) << "the same rays again say nothing new";
  c.planner.ray_window = 0.5;
  EXPECT_EQ(times(48, 36), 2.0);
  const PinholeCamera camera = c.sensor.camera();
  EXPECT_EQ(finer_rays(c, camera).directions, RayBundle::regular(camera, 24, 18, 0.5).directions);
  c.planner.ray_refinement = 1;
  EXPECT_EQ(times(480, 360), 0.0) << "switched off";
  c.planner.ray_refinement = 4, c.planner.semantics = Semantics::reference;
  EXPECT_EQ(times(480, 360), 0.0) << "the reference code has none";
}

}  // namespace
}  // namespace nextview
