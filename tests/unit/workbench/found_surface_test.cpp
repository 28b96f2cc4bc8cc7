// The surface that the window shows, and the thread that makes it.
#include <atomic>
#include <chrono>

#include "tests/unit/workbench/inspected_scan.hpp"
#include "ui/workbench/inspection_worker.hpp"

namespace nextview {
namespace {

using namespace std::chrono_literals;

void wait_for(const InspectionWorker& worker) {
  while (worker.busy()) std::this_thread::sleep_for(1ms);
}

TEST(FoundSurface, LiesWhereTheSphereIs) {
  InspectedScan scan(scan_by("occlusion-aware"));
  for (int i = 0; i < 4; ++i) scan.step();
  const auto session = scan.runner.snapshot();
  const double radius = session->mesh->bounding_box().sizes().x() / 2;
  for (const SurfaceSource source : {SurfaceSource::map, SurfaceSource::cloud}) {
    const auto found = find_surface({session, source}, {}, {});
    ASSERT_NE(found, nullptr);
    const Surface& surface = found->found.surface;
    ASSERT_GT(surface.mesh.triangles.size(), 100u) << surface.why_empty;
    const SurfaceError& error = found->found.surface_error.value();
    ASSERT_EQ(error.at_vertices.size(), surface.mesh.vertices.size());
    double worst = 0;  // the known mesh has flat triangles, so the distances differ by a little
    for (std::size_t i = 0; i < surface.mesh.vertices.size(); ++i)
      worst = std::max(worst, std::abs(error.at_vertices[i] - (surface.mesh.vertices[i].norm() - radius)));
    EXPECT_LT(worst, 0.02 * radius);
    EXPECT_LT(error.percentile_95, 1.5 * session->grid.resolution);
  }
}

TEST(FoundSurface, OfNoViewsIsNone) {
  InspectedScan scan(scan_by("occlusion-aware"));
  const auto found = find_surface({scan.runner.snapshot(), SurfaceSource::cloud}, {}, {});
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->found.surface.empty());
}

TEST(FoundSurface, IsAskedAgainWhenItIsAnother) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  const SurfaceQuestion before{scan.runner.snapshot(), SurfaceSource::cloud};
  SurfaceQuestion other_map = before, of_map = before;
  other_map.map = MapChoice::gibbs;
  EXPECT_TRUE(before.same_as(other_map)) << "the points are the same";
  of_map.source = SurfaceSource::map;
  EXPECT_FALSE(before.same_as(of_map));
  scan.step();
  EXPECT_FALSE(before.same_as({scan.runner.snapshot(), SurfaceSource::cloud}));
}

TEST(InspectionWorker, TheNewestSurfaceIsTheOneThatIsMade) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  std::atomic<int> news = 0;
  InspectionWorker worker([&] { ++news; });
  EXPECT_EQ(worker.surface()->of.session, nullptr);
  for (int i = 0; i < 5; ++i) {
    worker.ask_surface({scan.runner.snapshot(), SurfaceSource::cloud});
    worker.ask_surface({scan.runner.snapshot(), SurfaceSource::map});
  }
  wait_for(worker);
  EXPECT_EQ(worker.surface()->of.source, SurfaceSource::map);
  EXPECT_EQ(worker.surface_progress(), std::nullopt);
  EXPECT_GT(news, 0);
  const auto kept = worker.surface();
  worker.ask_surface({scan.runner.snapshot(), SurfaceSource::cloud});
  worker.drop_surface();
  wait_for(worker);
  EXPECT_TRUE(worker.surface() == kept || worker.surface()->of.source == SurfaceSource::cloud)
      << "it was stopped, or was done before";
}

}  // namespace
}  // namespace nextview
