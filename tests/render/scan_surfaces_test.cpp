// The pictures of real surfaces and of a real calibration, small enough to be made anew in some seconds.
#include "core/export/scan_surfaces.hpp"

#include <fmt/format.h>

#include "core/offline/map_calibration.hpp"
#include "core/view/candidate_views.hpp"
#include "tests/render/render_test.hpp"
#include "ui/figures/calibration_figure.hpp"
#include "ui/figures/surface_error_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

std::vector<Pose> views_around(int count) {
  CandidateViewsConfig layout;
  layout.layout = ViewLayout::fibonacci;
  layout.count = count;
  return candidate_views(layout, Vector3::Zero());
}

Configuration part_scan(const std::string& object, int width, double noise) {
  Configuration c;
  c.object.file = std::string(NEXTVIEW_SOURCE_DIR "/assets/objects/") + object + ".ply";
  c.sensor.width = width;
  c.sensor.height = width * 3 / 4;
  c.sensor.range_noise = noise;
  c.map.region_edge = 0.8;
  return c;
}

struct HousingSurfaces {
  std::size_t views;
  std::vector<ScanSurface> surfaces;
};

/// The slotted housing's, of its Gibbs map and of its cloud.
const HousingSurfaces& housing() {
  static const HousingSurfaces made = [] {
    const RefinementJob job = refinement_job(part_scan("slotted_housing", 320, 0.001), views_around(16));
    return HousingSurfaces{job.scans.size(), scan_surfaces(job, refine(job))};
  }();
  return made;
}

SurfacePicture picture_of(const ScanSurface& surface) {
  SurfacePicture picture;
  picture.title = "Slotted housing: the surface of " + surface.source;
  picture.remark = fmt::format("{} views of 320 × 240 pixels, 1 mm noise", housing().views);
  picture.caption = surface.caption;
  picture.openings = summary(surface.openings);
  picture.surface = &surface.surface;
  return picture;
}

TEST(Figures, InspectionOfTheCloudsSurface) {
  OffscreenTarget page(1600, 1000);
  const ScanSurface& cloud = housing().surfaces.at(1);
  ASSERT_TRUE(cloud.surface_error);
  expect_screenshot("surface_cloud", draw_surface_error_figure(page, picture_of(cloud), *cloud.surface_error));
}

TEST(Figures, InspectionOfThePosteriorsSurface) {
  OffscreenTarget page(1600, 1000);
  const ScanSurface& posterior = housing().surfaces.at(0);
  ASSERT_TRUE(posterior.surface_error);
  expect_screenshot("surface_posterior",
                    draw_surface_error_figure(page, picture_of(posterior), *posterior.surface_error));
}

TEST(Figures, UncertaintyOfTheCloudsSurface) {
  OffscreenTarget page(1600, 1000);
  expect_screenshot("surface_uncertainty", draw_surface_figure(page, picture_of(housing().surfaces.at(1))));
}

TEST(Figures, Calibration) {
  std::vector<CalibrationExample> examples;
  for (const auto& [object, held_out] : {std::pair{"slotted_plate", false}, {"slotted_housing", true}})
    for (const int views : {4, 12}) {
      CalibrationExample example{refinement_job(part_scan(object, 160, 0.002), views_around(views)), held_out};
      examples.push_back(std::move(example));
    }
  expect_screenshot("calibration", draw_calibration_figure(calibrate_map(std::move(examples), {})));
}

}  // namespace
}  // namespace nextview
