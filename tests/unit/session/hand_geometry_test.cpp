// What a session knows of surfaces that are seen, hidden and occluded, on plates where a ruler tells the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/file/atomic_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

constexpr double half_large = 0.2, half_small = 0.05;  // of the plates' edges [m]

/// Two square plates at right angles to an axis, around it: a large one at -gap/2, a small one at +gap/2.
struct Plates {
  int axis;
  double gap;          ///< [m]
  double half_second;  ///< of the edge of the one at +gap/2 [m]

  std::string obj() const {
    std::string text;
    for (const auto& [half, height] : {std::pair(half_large, -0.5 * gap), {half_second, 0.5 * gap}})
      for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        Vector3 corner;
        corner[axis] = height, corner[(axis + 1) % 3] = a * half, corner[(axis + 2) % 3] = b * half;
        text += fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
      }
    return text + "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";
  }
};

class HandGeometry : public InTemporaryFolder {
 protected:
  Configuration plates(const Plates& plates) const {
    Configuration c = small_scan();
    write_file(folder_ / "plates.obj", plates.obj());
    c.object.file = (folder_ / "plates.obj").string();
    for (const Setting& setting : settings(c))  // no length is to follow from the plates' size
      c.sources[setting.key] = {setting.key, "", setting.text()};
    c.sensor.range_noise = 0.0;
    c.cloud.outlier_removal = false;
    return c;
  }
};

/// Whether the line between two points passes the square of half an edge `half` at z = `height`; nothing if it comes
/// too near its edge to say.
std::optional<bool> misses(const Vector3& from, const Vector3& to, double height, double half) {
  if ((from.z() - height) * (to.z() - height) >= 0.0) return false;
  const Vector3 at = from + (to - from) * ((height - from.z()) / (to.z() - from.z()));
  const double farther = std::max(std::abs(at.x()), std::abs(at.y()));
  if (std::abs(farther - half) < 2e-4) return std::nullopt;
  return farther < half;
}

/// Whether a camera sees a point of the plates (across z), from the definition; nothing if it is too close to call.
std::optional<bool> sees(const DepthCameraConfig& camera, double gap, const Pose& view, const Vector3& point) {
  bool close = false;
  const auto below = [&](double value, double limit) {
    close |= std::abs(value - limit) < 1e-4;
    return value < limit;
  };
  const Vector3 local = view.inverse() * point, eye = view.translation();
  const double tangent = std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180.0);
  const double range = (point - eye).norm(), slant = std::acos(std::abs(point.z() - eye.z()) / range);
  bool seen = local.z() > 0.0;
  seen &= below(std::abs(local.x() / local.z()), tangent);
  seen &= below(std::abs(local.y() / local.z()), tangent * camera.height / camera.width);
  seen &= below(camera.min_range, range) & below(range, camera.max_range);
  seen &= below(slant, camera.grazing_limit * std::numbers::pi / 180.0);
  const bool on_large = point.z() < 0.0;
  const auto hidden = on_large ? misses(eye, point, 0.5 * gap, half_small) : misses(eye, point, -0.5 * gap, half_large);
  if (close || !hidden) return std::nullopt;
  return seen && !*hidden;
}

TEST_F(HandGeometry, SamplesAreSeenWhereNothingIsInBetween) {
  for (const double gap : {0.03, 0.003}) {
    Configuration c = plates({2, gap, half_small});
    c.sensor.min_range = 0.3, c.sensor.max_range = 0.7, c.sensor.grazing_limit = 60;
    const Session session(c);
    const KnownObject& object = *session.known_object();
    int seen = 0, hidden_behind_the_small_one = 0;
    for (const Vector3& eye :
         {Vector3(0, 0.01, 0.5), Vector3(0.25, 0.1, 0.4), Vector3(-0.3, 0.35, 0.3), Vector3(0.1, 0, -0.5),
          Vector3(0.02, 0, 0.25), Vector3(0, 0, 0.68), Vector3(0.4, 0, 0.2)}) {
      const Pose view = look_at(eye, Vector3(0.05, 0.03, 0));
      const auto found = object.samples_seen(view);
      std::vector<std::uint8_t> is_seen(object.samples().points.size());
      for (const std::uint32_t s : found) is_seen[s] = 1;
      for (std::size_t s = 0; s < is_seen.size(); ++s) {
        const Vector3 point = object.samples().points[s].cast<double>();
        const auto expected = sees(c.sensor, gap, view, point);
        if (!expected) continue;
        ASSERT_EQ(is_seen[s] != 0, *expected)
            << "gap " << gap << ", " << point.transpose() << " from " << eye.transpose();
        seen += *expected;
        hidden_behind_the_small_one += point.z() < 0.0 && misses(eye, point, 0.5 * gap, half_small) == true;
      }
    }
    EXPECT_GT(seen, 2000);
    EXPECT_GT(hidden_behind_the_small_one, 100);
  }
}

TEST_F(HandGeometry, VisibleIsWhatSomeCandidateSees) {
  const Configuration c = plates({2, 0.03, half_small});
  const Session session(c);
  const KnownObject& object = *session.known_object();
  std::size_t invisible = 0;
  for (std::size_t s = 0; s < object.visible().size(); ++s) {
    bool seen = false, certain = true;
    for (const Pose& view : session.candidates()) {
      const auto sees_it = sees(c.sensor, 0.03, view, object.samples().points[s].cast<double>());
      certain &= sees_it.has_value();
      seen |= sees_it == true;
    }
    if (certain || seen) {
      ASSERT_EQ(object.visible()[s] != 0, seen) << s;
    }
    invisible += !object.visible()[s];
  }
  EXPECT_LT(invisible, object.visible().size());
}

/// Two plates across x, so close that the second is the same to a voxel; the camera on the x axis.
Configuration facing_x(Configuration c) {
  c.planner.gain = "proximity-count";
  c.planner.start_azimuth = c.planner.start_elevation = 0.0;
  c.map.resolution = 0.02;
  c.termination.views = 2;
  return c;
}

// The paper's reach is 0.3 m behind the surface, whatever the voxel.
TEST_F(HandGeometry, OcclusionsReachThreeTenthsOfAMetreBehindTheSurface) {
  for (const double resolution : {0.02, 0.03}) {
    Configuration c = facing_x(plates({0, 0.01, half_large}));
    c.map.resolution = resolution;
    Session session(c);
    session.step();
    const VoxelGrid& grid = session.map().grid();
    const Vector3 eye = session.records()[0].T_world_camera.translation();
    ASSERT_LT((eye - Vector3(0.9, 0, 0)).norm(), 1e-9);
    const double surface = 0.005, half_diagonal = 0.5 * std::sqrt(3.0) * resolution;
    double farthest = 0.0;
    for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
      if (session.map().voxels()[v].occlusion_distance == 0) continue;
      const Vector3 centre = grid.centre(v);
      const double behind = (centre - eye).norm() * (surface - centre.x()) / (eye.x() - centre.x());
      ASSERT_LT(behind, 0.3 + half_diagonal + 1e-6) << centre.transpose();
      ASSERT_GT(behind, -half_diagonal) << centre.transpose();
      farthest = std::max(farthest, behind);
    }
    EXPECT_GT(farthest, 0.3 - half_diagonal);
  }
}

// Along the axis the k-th voxel behind the surface's is marked k. The 0.3 m end in the 15th voxel of 2 cm, which does
// not count, as no traversal's last one does.
TEST_F(HandGeometry, OcclusionsCountTheVoxelsBehindTheSurface) {
  Session session(facing_x(plates({0, 0.01, half_large})));
  session.step();
  const VoxelGrid& grid = session.map().grid();
  for (int k = 1; k <= 20; ++k) {
    const Voxel& voxel = session.map().voxels()[grid.index(grid.cell_at({0.01 - 0.02 * k, 0.01, 0.01}))];
    EXPECT_FALSE(voxel.measured) << k;
    EXPECT_EQ(int(voxel.occlusion_distance), k < 15 ? k : 0) << k;
  }
}

// Proximity count adds d_max - k for the k-th voxel behind a surface, d_max = 2 * 0.3 m: 30 voxels of 2 cm.
TEST_F(HandGeometry, ProximityCountsDownFromTwiceTheReach) {
  Session session(facing_x(plates({0, 0.01, half_large})));
  session.step();
  const auto why = session.explain(look_at({-0.9, 0.2, 0.1}, Vector3::Zero()));
  ASSERT_TRUE(why.has_value());
  const VoxelGrid& grid = session.map().grid();
  int counted = 0;
  for (const auto& ray : why->rays)
    for (const auto& voxel : ray.voxels) {
      const Eigen::Vector3i cell = Eigen::Vector3i(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) - grid.first;
      const Voxel& of_map = session.map().voxels()[grid.index(cell)];
      const bool counts = !of_map.measured && of_map.occlusion_distance > 0;
      ASSERT_EQ(voxel.contribution, counts ? 30.0 - of_map.occlusion_distance : 0.0);
      counted += counts;
    }
  EXPECT_GT(counted, 100);
}

// Visited: what a noise-free ray passes or ends in. Before the plate that is its cone; behind it, its shadow is not.
TEST_F(HandGeometry, VisitedVoxelsLieOnRaysAndNotBehindWhatStopsThem) {
  Configuration c = facing_x(plates({0, 0.01, half_large}));
  c.sensor.range_noise = 0.01;  // which marks nothing
  c.sensor.width = 320, c.sensor.height = 240;
  Session session(c);
  session.step();
  const VoxelGrid& grid = session.map().grid();
  const double half_width = std::tan(0.5 * c.sensor.field_of_view * std::numbers::pi / 180.0);
  std::size_t visited = 0;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    const Vector3 centre = grid.centre(v);
    const double depth = 0.9 - centre.x();
    const double across = std::abs(centre.y()) / depth, up = std::abs(centre.z()) / depth;
    const double margin = 0.02 / depth;
    const bool in_image = across < half_width - margin && up < 0.75 * half_width - margin;
    const bool off_image = across > half_width + margin || up > 0.75 * half_width + margin;
    const double shadow = half_large / 0.895;
    const bool behind = centre.x() < -0.02 && std::max(across, up) < shadow - margin;
    const bool beside = std::max(across, up) > shadow + margin || centre.x() > 0.005;
    const bool is_visited = session.evaluation()->visited_voxels[v] != 0;
    if (off_image || behind) {
      ASSERT_FALSE(is_visited) << centre.transpose();
    }
    if (in_image && beside && (centre - Vector3(0.9, 0, 0)).norm() < 1.46) {
      ASSERT_TRUE(is_visited) << centre.transpose();
    }
    visited += is_visited;
  }
  EXPECT_GT(visited, 20'000u);
}

}  // namespace
}  // namespace nextview
