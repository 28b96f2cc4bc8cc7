#include "core/export/scan_surfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <nlohmann/json.hpp>

#include "core/file/atomic_file.hpp"
#include "core/file/own_folder.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/surface/map_surface.hpp"
#include "core/view/candidate_views.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The sphere of 0.25 m radius, seen from all around.
Configuration sphere_scan(int views) {
  Configuration c = small_scan();
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/sphere.ply";
  c.sensor.width = 160, c.sensor.height = 120;
  c.sensor.range_noise = 0.001;
  c.map.resolution = 0.02, c.map.region_edge = 0.64;
  c.views.layout = ViewLayout::fibonacci;
  c.views.count = views;
  c.planner.gain = "fixed-order";
  c.termination.views = views;
  c.evaluation.surface_samples = 1000;
  return c;
}

/// 95 % of the seen surface lie at most so far from the sphere [m]: our own measure.
double distance_to_sphere(const Surface& surface) {
  TriangleMesh seen;
  seen.vertices = surface.mesh.vertices;
  for (const auto& t : surface.mesh.triangles)
    if (surface.seen[t[0]] && surface.seen[t[1]] && surface.seen[t[2]]) seen.triangles.push_back(t);
  std::vector<double> distances;
  for (const Eigen::Vector3f& p : sample_surface(seen, 20'000, 5).points)
    distances.push_back(std::abs(p.norm() - 0.25));
  std::sort(distances.begin(), distances.end());
  return distances[distances.size() * 95 / 100];
}

void expect_near_the_sphere(const ScanSurface& s, double limit) {
  SCOPED_TRACE(s.name);
  ASSERT_FALSE(s.surface.empty()) << s.surface.why_empty;
  const double distance = distance_to_sphere(s.surface);
  EXPECT_LT(distance, limit);
  ASSERT_TRUE(s.surface_error.has_value());
  EXPECT_NEAR(s.surface_error->percentile_95, distance, 0.0003) << "the part's facets are 0.1 mm off a sphere";
  EXPECT_GT(s.surface_error->area_seen, 0.95 * s.surface.mesh.surface_area());
  EXPECT_EQ(s.openings.size(), 0u);
}

TEST(ScanSurfaces, OfAScanFromAllSidesLieOnTheObject) {
  const Configuration c = sphere_scan(24);
  Session session(c);
  finish(session);
  const auto surfaces = scan_surfaces(session);
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].name, "surface_map");
  EXPECT_EQ(surfaces[1].name, "surface_cloud");
  expect_near_the_sphere(surfaces[0], 0.5 * c.map.resolution);
  expect_near_the_sphere(surfaces[1], 0.002);
}

TEST(ScanSurfaces, TheGroundBelowTheObjectIsNoErrorOfTheirs) {
  Configuration c = sphere_scan(12);
  c.object.ground = true;
  Session session(c);
  finish(session);
  const auto surfaces = scan_surfaces(session);
  ASSERT_EQ(surfaces.size(), 2u);
  for (const ScanSurface& surface : surfaces) {
    ASSERT_TRUE(surface.surface_error) << surface.name;
    EXPECT_LT(surface.surface_error->percentile_95, c.map.resolution) << surface.name;
    EXPECT_LT(surface.surface_error->area_seen + surface.surface_error->area_unseen,
              0.9 * surface.surface.mesh.surface_area())
        << surface.name;
  }
}

TEST(ScanSurfaces, OfARefinementLieOnTheObject) {
  const Configuration c = sphere_scan(24);
  const RefinementJob job = refinement_job(c, candidate_views(c.views, Vector3::Zero()));
  const auto surfaces = scan_surfaces(job, refine(job));
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].name, "surface_posterior");
  EXPECT_EQ(surfaces[1].name, "surface_cloud");
  expect_near_the_sphere(surfaces[0], 0.5 * c.map.resolution);
  expect_near_the_sphere(surfaces[1], 0.002);
}

TEST(ScanSurfaces, SayWhereTheTrueMeshHasNoInside) {
  const OwnFolder own;
  const std::filesystem::path folder = own.path();
  write_file(folder / "corner.ply",  // three sides of a box
             "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0\n0.5 0 0\n0.5 0.5 0\n0 0.5 0\n0 0 0.5\n0.5 0 0.5\n0 0.5 0.5\n"
             "4 0 1 2 3\n4 0 1 5 4\n4 0 3 6 4\n");
  Configuration c = small_scan();
  for (const std::string& object : {c.object.file, (folder / "corner.ply").string()}) {
    c.object.file = object;
    Session session(c);
    session.step();
    const auto surfaces = scan_surfaces(session);
    ASSERT_EQ(surfaces.size(), 2u);
    for (const ScanSurface& s : surfaces)
      EXPECT_EQ(summary(s).ends_with(", whose mesh is not closed: which side of it is a guess"),
                object.ends_with("corner.ply"))
          << summary(s);
  }
}

TEST(ScanSurfaces, BeforeTheFirstStepThereAreReasons) {
  const Session session(small_scan());
  const auto surfaces = scan_surfaces(session);
  ASSERT_EQ(surfaces.size(), 2u);
  for (const ScanSurface& s : surfaces) {
    EXPECT_TRUE(s.surface.empty());
    EXPECT_FALSE(s.surface.why_empty.empty());
    EXPECT_TRUE(s.openings.empty());
    EXPECT_FALSE(s.surface_error);
    EXPECT_THAT(summary(s), HasSubstr(s.surface.why_empty));
    EXPECT_THAT(summary(s), Not(HasSubstr("\n")));
  }
}

TEST(ScanSurfaces, AreOfTheMapThatViewsArePlannedOn) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  Session session(c);
  session.step();
  const auto surfaces = scan_surfaces(session);
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].name, "surface_posterior");
  std::vector<Voxel> voxels = session.refinement()->voxels().dense();
  const double odds = c.gibbs.sampler.prior / (1.0 - c.gibbs.sampler.prior);
  for (Voxel& v : voxels)  // what the measurements left within a factor of two of the prior's odds is not decided
    v.measured =
        v.measured && !(v.probability > odds / (2.0 + odds) && v.probability < 2.0 * odds / (1.0 + 2.0 * odds));
  const Surface expected = map_surface(session.map().grid(), voxels);
  EXPECT_TRUE(surfaces[0].surface.mesh.vertices == expected.mesh.vertices);
  EXPECT_TRUE(surfaces[0].surface.uncertainty == expected.uncertainty);
  EXPECT_TRUE(surfaces[0].surface.seen == expected.seen);
  for (const ScanSurface& s : surfaces) EXPECT_THAT(summary(s), Not(HasSubstr("\n")));
}

TEST(ScanSurfaces, WithoutEvaluationNothingIsHeldAgainstTheTruth) {
  Configuration with = small_scan(), without = small_scan();
  without.evaluation.enabled = false;
  Session a(with), b(without);
  a.step();
  b.step();
  const auto known = scan_surfaces(a), unknown = scan_surfaces(b);
  ASSERT_EQ(known.size(), unknown.size());
  for (std::size_t k = 0; k < known.size(); ++k) {
    EXPECT_TRUE(known[k].surface_error);
    EXPECT_FALSE(unknown[k].surface_error);
    EXPECT_TRUE(known[k].surface.mesh.vertices == unknown[k].surface.mesh.vertices);
  }
}

// What is there after a stop is whole.
TEST(ScanSurfaces, AStopLeavesOutWhatWasNotMade) {
  Session session(small_scan());
  session.step();
  std::vector<double> fractions;
  const auto all = scan_surfaces(session, [&](double f, std::string_view) { fractions.push_back(f); });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  for (std::size_t moment = 0; moment < fractions.size(); ++moment) {
    std::stop_source stop;
    std::size_t calls = 0;
    const Progress stop_there = [&](double, std::string_view) {
      if (calls++ == moment) stop.request_stop();
    };
    const auto some = scan_surfaces(session, stop_there, stop.get_token());
    ASSERT_LE(some.size(), all.size());
    for (std::size_t k = 0; k < some.size(); ++k) {
      EXPECT_EQ(some[k].name, all[k].name);
      EXPECT_TRUE(some[k].surface.mesh.vertices == all[k].surface.mesh.vertices) << moment;
      EXPECT_EQ(some[k].openings.size(), all[k].openings.size()) << moment;
    }
  }
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_TRUE(scan_surfaces(session, {}, stopped.get_token()).empty());
}

TEST(ScanSurfaces, TheSameOnOneThreadAndTwo) {
  Session session(small_scan());
  session.step();
  session.step();
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return scan_surfaces(session);
  };
  const auto one = run(1), two = run(2);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(one[k].surface.mesh.vertices == two[k].surface.mesh.vertices);
    EXPECT_TRUE(one[k].surface.uncertainty == two[k].surface.uncertainty);
    EXPECT_TRUE(one[k].surface_error->at_vertices == two[k].surface_error->at_vertices);
    EXPECT_EQ(one[k].surface_error->rms, two[k].surface_error->rms);
  }
}

class ScanSurfaceFiles : public InTemporaryFolder {
 protected:
  nlohmann::json written() const { return nlohmann::json::parse(read_file(folder_ / "surfaces.json")); }
};

// A stop may leave none: then there is no file either. What is not on the folder's list stays, whatever its name.
TEST_F(ScanSurfaceFiles, OfNoSurfaces) {
  OutputFolder out = begun(folder_);
  write_file(folder_ / "surface_map.ply", "not ours");
  EXPECT_TRUE(write_surfaces({}, out).empty());
  EXPECT_EQ(read_file(folder_ / "surface_map.ply"), "not ours");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "surfaces.json"));
}

/// A square of two triangles beside one of four, of which `seen` corners are: 0 to 9 from the left.
ScanSurface strip(std::size_t seen) {
  ScanSurface s;
  s.name = "surface_map", s.source = "the occupancy map";
  for (int i = 0; i < 5; ++i)
    for (const float y : {0.0f, 0.1f}) s.surface.mesh.vertices.push_back({0.1f * float(i), y, 0.0f});
  for (std::uint32_t i = 0; i < 8; i += 2) {
    s.surface.mesh.triangles.push_back({i, i + 2, i + 1});
    s.surface.mesh.triangles.push_back({i + 1, i + 2, i + 3});
  }
  s.surface.uncertainty.assign(10, 0.001f);
  for (std::size_t i = 0; i < 10; ++i) s.surface.seen.push_back(i < seen);
  return s;
}

// Four squares of 0.01 m²; six corners hold the first two of them.
TEST_F(ScanSurfaceFiles, WhatWasNotSeenIsInAFileOfItsOwn) {
  const ScanSurface s = strip(6);
  OutputFolder out = begun(folder_);
  EXPECT_THAT(write_surfaces({&s, 1}, out), testing::UnorderedElementsAre("surface_map.ply", "surface_map.stl",
                                                                          "surface_map_unseen.stl", "surfaces.json"));
  EXPECT_EQ(load_mesh(folder_ / "surface_map.ply").triangles.size(), 8u);
  const auto area = [&](const char* name) {
    return 1e-6 * load_mesh(folder_ / name, {.longest_side = 0, .unit = LengthUnit::metres}).surface_area();
  };
  EXPECT_NEAR(area("surface_map.stl"), 0.02, 1e-6);
  EXPECT_NEAR(area("surface_map_unseen.stl"), 0.02, 1e-6);
  EXPECT_NEAR(double(written()["surface_map"]["area_seen_m2"]), 0.02, 1e-6);
  EXPECT_NEAR(double(written()["surface_map"]["area_unseen_m2"]), 0.02, 1e-6);
  EXPECT_THAT(read_file(folder_ / "surface_map.ply"), HasSubstr("comment seen of the area: 50 %, 0.02 of 0.04 m^2\n"));
  EXPECT_TRUE(read_file(folder_ / "surface_map.stl").starts_with("nextview, unit mm; what was seen"));
}

TEST_F(ScanSurfaceFiles, OfWhollySeenAndOfWhollyUnseenOnesThereIsOneStl) {
  const ScanSurface seen = strip(10), unseen = strip(0);
  OutputFolder one = begun(folder_ / "seen"), other = begun(folder_ / "unseen");
  EXPECT_THAT(write_surfaces({&seen, 1}, one), testing::Not(testing::Contains("surface_map_unseen.stl")));
  EXPECT_THAT(write_surfaces({&unseen, 1}, other), testing::Not(testing::Contains("surface_map.stl")));
}

// The openings are given, as a strip has always some.
TEST(ScanSurfaces, AreCalledWatertightOnlyIfAllWasSeen) {
  EXPECT_EQ(closedness(strip(10).surface, {}), "watertight, all of it seen: 400.0 cm²");
  EXPECT_EQ(closedness(strip(8).surface, {}),
            "closed, 75 % of it was seen: 300.0 cm² seen, 100.0 cm² is the hull of what no ray met");
  EXPECT_EQ(closedness(strip(4).surface, {}),
            "closed, but only 25 % of it was seen: 100.0 cm² seen, 300.0 cm² is the hull of what no ray met");
  EXPECT_EQ(closedness(strip(0).surface, {}),
            "closed, but only 0 % of it was seen: 0.0 cm² seen, 400.0 cm² is the hull of what no ray met");
  ScanSurface s = strip(10);
  s.openings = boundary_loops(s.surface.mesh);
  EXPECT_THAT(summary(s), HasSubstr("8 triangles, 1 opening, 1 m around"));
  s.surface.mesh.triangles.resize(1);
  EXPECT_THAT(summary(s), HasSubstr(" 1 triangle, "));
}

// A far return would make the cloud's lattice too large; it lies beyond the region, so it is left out.
TEST_F(ScanSurfaceFiles, AStrayPointBeyondTheRegionCostsNothing) {
  Configuration c = small_scan();
  c.termination.views = 1;
  RefinementJob job = refinement_job(c, std::vector<Pose>{candidate_views(c.views, Vector3::Zero()).front()});
  const Refinement refinement = refine(job);
  const auto without = scan_surfaces(job, refinement);
  job.scans[0].hits.push_back({900.0f, 800.0f, 700.0f});
  job.scans[0].hits.push_back({NAN, 0.0f, 0.0f});
  const auto with = scan_surfaces(job, refinement);
  ASSERT_EQ(with.size(), 2u);
  ASSERT_FALSE(without[1].surface.empty()) << without[1].surface.why_empty;
  EXPECT_EQ(with[1].surface.mesh.vertices, without[1].surface.mesh.vertices);
  EXPECT_EQ(with[1].surface.mesh.triangles, without[1].surface.mesh.triangles);
}

// The first number of this PLY's body begins with the byte that ends lines: its reader must not take it for one.
TEST_F(ScanSurfaceFiles, CanBeScannedAgain) {
  ScanSurface s;
  s.name = "surface_cloud";
  s.surface.mesh.vertices = {{0.16f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f}, {0.0f, 0.0f, 0.4f}};
  s.surface.mesh.triangles = {{0, 1, 2}};
  s.surface.uncertainty = {0.001f, 0.002f, 0.003f};
  s.surface.seen = {1, 1, 1};
  OutputFolder out = begun(folder_);
  write_surfaces({&s, 1}, out);
  for (const std::string ending : {".ply", ".stl"}) {
    TriangleMesh mesh;
    EXPECT_NO_THROW(mesh = load_mesh(folder_ / (s.name + ending), {.longest_side = 0.4})) << ending;
    EXPECT_NEAR(mesh.surface_area(), s.surface.mesh.surface_area(), 1e-6) << ending;
  }
}

TEST_F(ScanSurfaceFiles, ATruthThatNobodyCanSeeIsStillJson) {
  Configuration c = small_scan();
  RefinementJob job = refinement_job(c, std::vector<Pose>{candidate_views(c.views, Vector3::Zero()).front()});
  std::fill(job.truth->visible.begin(), job.truth->visible.end(), 0);
  const auto surfaces = scan_surfaces(job, refine(job));
  OutputFolder out = begun(folder_ / "out");
  write_surfaces(surfaces, out);
  const auto score =
      nlohmann::json::parse(read_file(out.path() / "surfaces.json"))["surface_cloud"]["surface_error"]["thresholds"][0];
  EXPECT_TRUE(score["completeness_visible"].is_null()) << "unknown, which JSON has no number for";
  EXPECT_TRUE(score["completeness_all"].is_number());
  std::filesystem::remove_all(out.path());
  EXPECT_THROW(write_surfaces(surfaces, out), std::runtime_error);
}

}  // namespace
}  // namespace nextview
