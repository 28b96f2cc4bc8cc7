// Figures of scans. One small scan for all: two-centimetre voxels, a coarse camera.
#include "ui/report/scan_figures.hpp"

#include <fstream>
#include <set>

#include "tests/render/render_test.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/report/scene_panel.hpp"

namespace nextview {
namespace {

Configuration plate_scan() {
  Configuration c;
  c.object.file = "slotted_plate";
  c.sensor.width = 160;
  c.sensor.height = 120;
  c.map.resolution = 0.02;
  c.planner.ray_columns = 16;
  c.planner.ray_rows = 12;
  c.evaluation.surface_samples = 2000;
  c.termination.views = 6;
  c.termination.surface_left = 0.0;
  return c;
}

ReportScan scan_of(const Configuration& configuration) {
  ReportScan scan;
  scan.session = std::make_unique<Session>(configuration);
  while (scan.session->finished().empty()) {
    scan.session->step();
    scan.states.push_back(scan.session->state());
  }
  scan.name = scan.session->name();
  return scan;
}

std::vector<ReportScan> scans() {
  std::vector<ReportScan> scans;
  ReportScan& scan = scans.emplace_back(scan_of(plate_scan()));
  scan.maps = [&session = *scan.session] {
    std::vector<Pose> views;
    for (const StepRecord& record : session.records()) views.push_back(record.T_world_camera);
    RefinementJob job = refinement_job(session.configuration(), views);
    Refinement maps = refine(job);
    return std::make_shared<ReportMaps>(std::move(job), std::move(maps));
  };
  return scans;
}

TEST(Figures, OfScans) {
  auto all = scans();
  OffscreenTarget target(64, 48);
  const FigurePaper paper{target, Look::light(), 1.0, {1, 2, 4, 6, 99}};  // the scan has no view 99
  for (const ScanFigure& figure : scan_figures())
    expect_screenshot("figure_" + figure.name, figure.draw(all, paper).image(target));
  const FigurePaper dark{target, Look::dark(), 1.0, {1, 6}};
  for (const ScanFigure& figure : scan_figures())
    if (figure.name == "data_flow" || figure.name == "strategy" || figure.name == "sensor")
      expect_screenshot("figure_" + figure.name + "_dark", figure.draw(all, dark).image(target));
}

TEST(Figures, OfTheSensorAreOfTheScansOwn) {
  Configuration c = plate_scan();
  c.sensor.range_noise = 0.005;
  c.termination.views = 1;
  std::vector<ReportScan> scans;
  scans.push_back(scan_of(c));
  OffscreenTarget target(64, 48);
  const std::string svg = sensor_figure(scans, {target, Look::light(), 1.0, {}}).svg();
  for (const char* text : {"σ = 5 mm, voxels", "σ_φ = 0.18°", ">875<", ">900<", ">925<", ">80<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Figures, WithoutTheirScenesAreAsLargeAsWithThem) {
  auto all = scans();
  OffscreenTarget target(64, 48);
  const VectorDrawing whole = strategy_figure(all, {target, Look::light(), 0.2, {1, 6}});
  const VectorDrawing laid_out = strategy_figure(all, {target, Look::light(), 0.0, {1, 6}});
  EXPECT_FALSE(whole.is_vector());
  EXPECT_TRUE(laid_out.is_vector());
  EXPECT_EQ(laid_out.width(), whole.width());
  EXPECT_EQ(laid_out.height(), whole.height());
}

TEST(ScenePanels, AreFramedByTheCloudWhereTheObjectIsNotKnown) {
  StepPicture picture;
  picture.grid = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  EXPECT_EQ(points_around(picture, true), corners({picture.grid.lower(), picture.grid.upper()}));
  picture.cloud = {{0.1f, 0.2f, 0.3f}, {0.4f, -0.2f, 0.0f}};
  const Eigen::AlignedBox3d box(Eigen::Vector3f(0.1f, -0.2f, 0.0f).cast<double>(),
                                Eigen::Vector3f(0.4f, 0.2f, 0.3f).cast<double>());
  EXPECT_EQ(points_around(picture, false), corners(box));
}

/// "gain cloud map": the rooms of core/CMakeLists.txt.
std::set<std::string> rooms() {
  std::ifstream file(std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "core" / "CMakeLists.txt");
  std::set<std::string> rooms;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("nextview_room(")) rooms.insert(line.substr(14, line.find_first_of(" )") - 14));
  return rooms;
}

TEST(DataFlow, IsOfRoomsThatThereAre) {
  std::set<std::string> boxes, joined;
  for (const FlowBox& box : flow_boxes()) {
    EXPECT_TRUE(rooms().contains(box.room)) << box.room;
    EXPECT_TRUE(boxes.insert(box.room).second) << box.room << " stands there twice";
  }
  for (const FlowArrow& arrow : flow_arrows()) joined.insert({arrow.from, arrow.to});
  EXPECT_EQ(joined, boxes) << "each box has an arrow, each arrow has boxes";
}

}  // namespace
}  // namespace nextview
