#include <gtest/gtest.h>

#include <algorithm>

#include "core/mesh/mesh_file.hpp"
#include "core/session/session_parts.hpp"
#include "core/surface/surface_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

template <class Error>
std::string reason(const Configuration& configuration) {
  try {
    const Session session(configuration);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
}

TEST(SessionEdge, AViewWithoutReturnsIsAView) {
  Configuration c = small_scan();
  c.sensor.max_range = 0.3;  // the object begins farther away
  Session session(c);
  finish(session);
  ASSERT_EQ(session.records().size(), 4u);
  for (const StepRecord& r : session.records()) {
    EXPECT_EQ(r.hits, 0u);
    EXPECT_EQ(r.misses, 80u * 60u);
    EXPECT_EQ(r.coverage, 0.0);
  }
  for (const Voxel& v : session.map().voxels()) EXPECT_LE(v.probability, 0.5f);
}

TEST(SessionEdge, AViewOfInvalidPixelsAloneSaysNothing) {
  Configuration c = small_scan();
  c.sensor.dropout = 1.0;
  c.termination.views = 2;
  if (!reason<std::invalid_argument>(c).empty()) c.sensor.dropout = 0.999999;  // a limit below 1 is fine too
  Session session(c);
  finish(session);
  for (const StepRecord& r : session.records()) {
    EXPECT_LE(r.hits + r.misses, 2u);
    EXPECT_LE(r.new_voxels, 100u);
  }
}

TEST(SessionEdge, OneCandidateAndOnePixel) {
  Configuration c = small_scan();
  c.views.count = 1;
  c.sensor.width = c.sensor.height = 1;
  c.planner.ray_columns = c.planner.ray_rows = 1;
  Session session(c);
  finish(session);
  EXPECT_EQ(session.records().size(), 2u);
}

TEST(SessionEdge, AnObjectLargerThanTheRegionIsAnErrorWithAdvice) {
  Configuration c = small_scan();
  c.map.region_edge = 0.4;
  const std::string why = reason<std::invalid_argument>(c);
  EXPECT_NE(why.find("map.region_edge"), std::string::npos) << why;
  EXPECT_NE(why.find("object.longest_side"), std::string::npos) << why;
}

TEST(SessionEdge, AnObjectThatStaysFarFromTheOriginIsScannedWhereItIs) {
  const TemporaryFolder folder;
  const Vector3 middle(5.06, -3.0, 0.25);
  TriangleMesh moved = load_mesh(small_scan().object.file);
  for (Eigen::Vector3f& vertex : moved.vertices) vertex += middle.cast<float>();
  write_stl(moved, folder / "moved.stl");
  Configuration c = small_scan();
  c.object.file = (folder / "moved.stl").string();
  c.object.centred = false;
  Session session(c);
  EXPECT_LT((session.setup().region.box().center() - middle).norm(), 1.1 * c.map.resolution);
  EXPECT_LT((view_target(session.configuration()) - middle).norm(), 1e-5);
  for (const Pose& pose : session.candidates()) {
    EXPECT_LT((middle - pose.translation()).cross(pose.linear().col(2)).norm(), 1e-5);
    EXPECT_NEAR((middle - pose.translation()).norm(), session.configuration().views.radius, 1e-5);
  }
  finish(session);
  EXPECT_GT(session.records().back().coverage_visible, 0.5);
  c.map.region_edge = 0.4;
  EXPECT_NE(reason<std::invalid_argument>(c).find("enlarge map.region_edge"), std::string::npos);
  c.map.region = "-0.4 -0.4 -0.4 0.4 0.4 0.4";
  EXPECT_NE(reason<std::invalid_argument>(c).find("enlarge map.region,"), std::string::npos) << "which was given";
}

TEST(SessionEdge, WithoutEvaluationNothingIsKnownOfTheObject) {
  Configuration with = small_scan(), without = small_scan();
  without.evaluation.enabled = false;
  Session a(with), b(without);
  EXPECT_TRUE(a.known_object());
  EXPECT_FALSE(b.known_object());
  finish(a);
  finish(b);
  EXPECT_TRUE(same_map(a.map(), b.map()));  // looking at the truth changes nothing
  EXPECT_TRUE(same_scans(a, b));
  for (const StepRecord& r : b.records()) EXPECT_EQ(r.coverage, 0.0);
}

TEST(SessionEdge, BadSettingsAndFilesAreErrors) {
  Configuration bad_range = small_scan(), no_file = small_scan(), no_views = small_scan();
  bad_range.sensor.max_range = -1;
  no_file.object.file = "/nonexistent/thing.ply";
  no_views.views.layout = ViewLayout::file;
  no_views.views.file = "/nonexistent/views.txt";
  EXPECT_NE(reason<std::invalid_argument>(bad_range).find("max_range"), std::string::npos);
  EXPECT_NE(reason<std::runtime_error>(no_file).find("/nonexistent/thing.ply"), std::string::npos);
  EXPECT_NE(reason<std::runtime_error>(no_views).find("/nonexistent/views.txt"), std::string::npos);
  for (const char* gain : {"oracle", "covering-order", "set-cover"}) {
    Configuration blind = small_scan();
    blind.planner.gain = gain;
    blind.evaluation.enabled = false;
    EXPECT_NE(reason<std::invalid_argument>(blind).find("evaluation.enabled"), std::string::npos) << gain;
  }
}

TEST(SessionEdge, PreparingCanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(Session(small_scan(), {}, stop.get_token()), std::runtime_error);
}

TEST(SessionEdge, TheObjectIsScaledOrKept) {
  Configuration scaled = small_scan(), kept = small_scan();
  scaled.object.longest_side = 0.25;
  kept.object.longest_side = 0.0;
  EXPECT_NEAR(Session(scaled).mesh()->bounding_box().sizes().maxCoeff(), 0.25, 1e-6);
  EXPECT_NEAR(Session(kept).mesh()->bounding_box().sizes().maxCoeff(), 0.5, 1e-6);
}

// The map of an ideal scan of a sphere: free in front, occupied where the box is, nothing measured inside.
TEST(SessionEdge, TheMapShowsTheObject) {
  Configuration c = small_scan();
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/sphere.ply";
  c.sensor.range_noise = 0.0;
  c.sensor.width = 160, c.sensor.height = 120;
  c.views.count = 20, c.termination.views = 14;
  Session session(c);
  finish(session);
  const VoxelGrid& grid = session.map().grid();
  std::size_t occupied = 0, surface = 0;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    const double distance = grid.centre(v).norm();  // the sphere's radius is 0.25 m
    const Voxel& voxel = session.map().voxels()[v];
    if (distance > 0.25 + 0.04 && voxel.measured) {
      EXPECT_LT(voxel.probability, 0.5) << distance;
    }
    if (distance < 0.25 - 0.04) {
      EXPECT_FALSE(voxel.measured) << distance;
    }
    if (std::abs(distance - 0.25) < 0.01) ++surface, occupied += voxel.probability > 0.5;
  }
  EXPECT_GT(double(occupied), 0.95 * double(surface));
}

}  // namespace
}  // namespace nextview
