// What each command of scene, selection and window does to the window's state, and that it does nothing else.
#include <gmock/gmock.h>

#include "tests/unit/workbench/inspected_scan.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Kind = ViewSelection::Kind;

/// All of the state that scene commands change, to be compared.
auto scene_state(const WindowState& w) {
  const LayerChoice& l = w.layers;
  const VoxelFilter& v = l.voxels;
  return std::tuple(l.object, l.cloud, l.octree, l.views, l.rays, l.region, l.missed, l.object_style, l.cloud_colouring,
                    l.map, l.colouring, l.ranges_locked, v.occupied, v.unknown, v.free, v.uncertain, v.unknown_from,
                    v.entropy_from, v.slice.has_value(), w.front, w.curves, w.sort_column, w.sort_ascending,
                    w.palette_open, w.shortcuts_open, w.picture.has_value(), w.quit, l.surface, l.surface_source,
                    l.surface_colouring, l.second, l.section.has_value(), w.orthographic, w.dark, w.place_sizes.left);
}

class CommandEffects : public testing::Test {
 protected:
  CommandEffects() : scan_(small_scan()) {
    scan_.step();
    scan_.step();
  }
  void run(const std::string& line) {
    CommandTarget target{worker_, window_, scan_.now(), {}};
    execute(parse_call(line), target);
  }
  /// That a line changes what `change` changes.
  void expect_effect(const std::string& line, const std::function<void(WindowState&)>& change) {
    WindowState expected = window_;
    change(expected);
    EXPECT_NE(scene_state(expected), scene_state(window_)) << line << " is to change nothing";
    run(line);
    EXPECT_EQ(scene_state(window_), scene_state(expected)) << line;
  }
  std::string error_of(const std::string& line) {
    try {
      run(line);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  }

  InspectedScan scan_;
  SessionWorker worker_;
  WindowState window_;
};

TEST_F(CommandEffects, WhatASurfacePutAsideComesBackWithoutIt) {
  LayerChoice& layers = window_.layers;
  layers.cloud = true, layers.octree = false;
  for (const char* line : {"toggle-missed", "toggle-surface", "toggle-surface"}) run(line);
  EXPECT_TRUE(layers.cloud);
  EXPECT_FALSE(layers.octree || layers.missed || layers.surface);
  run("toggle-missed");
  run("toggle-octree");
  run("toggle-missed");
  EXPECT_TRUE(layers.octree) << "it was switched on meanwhile";
  EXPECT_FALSE(layers.cloud);
}

TEST_F(CommandEffects, EachLayerIsSwitchedByItsOwn) {
  for (int twice = 0; twice < 2; ++twice) {
    expect_effect("toggle-object", [](WindowState& w) { w.layers.object ^= true; });
    expect_effect("toggle-cloud", [](WindowState& w) { w.layers.cloud ^= true; });
    expect_effect("toggle-octree", [](WindowState& w) { w.layers.octree ^= true; });
    expect_effect("toggle-views", [](WindowState& w) { w.layers.views ^= true; });
    expect_effect("toggle-rays", [](WindowState& w) { w.layers.rays ^= true; });
    expect_effect("toggle-region", [](WindowState& w) { w.layers.region ^= true; });
    const auto alone = [](WindowState& w, bool LayerChoice::*shown) {
      const bool now = !(w.layers.*shown);
      w.layers.missed = w.layers.surface = false;
      w.layers.*shown = now;
      w.layers.octree = !now;  // which would be in front of it, as the points would
      if (now) w.layers.cloud = false;
    };
    expect_effect("toggle-missed", [&](WindowState& w) { alone(w, &LayerChoice::missed); });
    expect_effect("toggle-surface", [&](WindowState& w) { alone(w, &LayerChoice::surface); });
    expect_effect("toggle-occupied", [](WindowState& w) { w.layers.voxels.occupied ^= true; });
    expect_effect("toggle-unknown", [](WindowState& w) { w.layers.voxels.unknown ^= true; });
    expect_effect("toggle-free", [](WindowState& w) { w.layers.voxels.free ^= true; });
    expect_effect("toggle-uncertain", [](WindowState& w) { w.layers.voxels.uncertain ^= true; });
    expect_effect("toggle-orthographic", [](WindowState& w) { w.orthographic ^= true; });
    expect_effect("dark", [](WindowState& w) { w.dark ^= true; });
    expect_effect("lock-ranges", [](WindowState& w) { w.layers.ranges_locked ^= true; });
    expect_effect("palette", [](WindowState& w) { w.palette_open ^= true; });
    expect_effect("shortcuts", [](WindowState& w) { w.shortcuts_open ^= true; });
  }
}

TEST_F(CommandEffects, EachChoiceIsTheOneOfItsName) {
  expect_effect("object-style wire", [](WindowState& w) { w.layers.object_style = MeshStyle::wire; });
  expect_effect("object-style solid", [](WindowState& w) { w.layers.object_style = MeshStyle::solid; });
  expect_effect("cloud-colour view", [](WindowState& w) { w.layers.cloud_colouring = CloudColouring::by_view; });
  expect_effect("cloud-colour height", [](WindowState& w) { w.layers.cloud_colouring = CloudColouring::by_height; });
  expect_effect("cloud-colour distance",
                [](WindowState& w) { w.layers.cloud_colouring = CloudColouring::by_distance; });
  expect_effect("voxel-map gibbs", [](WindowState& w) { w.layers.map = MapChoice::gibbs; });
  expect_effect("voxel-colour probability",
                [](WindowState& w) { w.layers.colouring = VoxelColouring::by_probability; });
  expect_effect("voxel-colour entropy", [](WindowState& w) { w.layers.colouring = VoxelColouring::by_entropy; });
  expect_effect("voxel-colour difference", [](WindowState& w) { w.layers.colouring = VoxelColouring::by_difference; });
  expect_effect("voxel-colour error", [](WindowState& w) { w.layers.colouring = VoxelColouring::by_error; });
  expect_effect("threshold 0.4", [](WindowState& w) { w.layers.voxels.unknown_from = 0.4; });
  expect_effect("uncertain-from 0.3", [](WindowState& w) { w.layers.voxels.entropy_from = 0.3; });
  expect_effect("surface-of map", [](WindowState& w) { w.layers.surface_source = SurfaceSource::map; });
  expect_effect("surface-colour uncertainty",
                [](WindowState& w) { w.layers.surface_colouring = SurfaceColouring::by_uncertainty; });
  expect_effect("surface-colour single", [](WindowState& w) { w.layers.surface_colouring = SurfaceColouring::single; });
  expect_effect("second-view gibbs", [](WindowState& w) { w.layers.second = SecondView::gibbs; });
  expect_effect("second-view none", [](WindowState& w) { w.layers.second = SecondView::none; });
  expect_effect("panel-sizes 300 400 200", [](WindowState& w) { w.place_sizes = {300, 400, 200}; });
  expect_effect("panel gibbs", [](WindowState& w) { w.front = {w.front[0], panel_name::gibbs, w.front[2]}; });
  expect_effect("panel layers", [](WindowState& w) { w.front = {"layers", w.front[1], w.front[2]}; });
  expect_effect("panel log", [](WindowState& w) { w.front = {w.front[0], w.front[1], "log"}; });
  expect_effect("curves gain time", [](WindowState& w) {
    w.curves = {CurveKind::gain, CurveKind::time};
    w.front[2] = panel_name::curves;
  });
  expect_effect("curves divergence coverage", [](WindowState& w) {
    w.curves = {CurveKind::divergence, CurveKind::coverage};
  });
  expect_effect("sort cost ascending", [](WindowState& w) {
    w.sort_column = CandidateColumn::cost;
    w.sort_ascending = true;
  });
  expect_effect("sort gain descending", [](WindowState& w) {
    w.sort_column = CandidateColumn::gain;
    w.sort_ascending = false;
  });
  expect_effect("save-picture a.png", [](WindowState& w) { w.picture = PictureRequest{}; });
  expect_effect("quit", [](WindowState& w) { w.quit = true; });
}

TEST_F(CommandEffects, ASectionKeepsTheHalfAwayFromTheCamera) {
  const auto& section = window_.layers.section;
  EXPECT_THAT(error_of("section-at 0.1"), HasSubstr("choose an axis first"));
  window_.scene_camera.translation() = Vector3(3, -2, 1);
  run("section-axis x");
  EXPECT_EQ(section.value(), (Section{0, 0.0, false})) << "through the middle of the sphere";
  EXPECT_TRUE(section->holds(Vector3(-0.1, 5, 5)));
  EXPECT_FALSE(section->holds(Vector3(0.1, 0, 0)));
  run("section-axis y");
  EXPECT_TRUE(section.value().keeps_upper) << "the camera is where y is negative";
  run("section-at 0.05");
  EXPECT_EQ(section->at, 0.05);
  run("flip-section");
  EXPECT_FALSE(section->keeps_upper);
  run("section-axis none");
  EXPECT_FALSE(section);
  run("section-axis");
  EXPECT_EQ(section.value().axis, 0);
  run("section-axis");
  EXPECT_FALSE(section) << "the same key closes it";
}

TEST_F(CommandEffects, DemosShowWhatIsSaidByTheirOwnTime) {
  Presentation& p = window_.presentation;
  run("caption \"one\"");
  run("title Title Subtitle 2");
  EXPECT_EQ(p.title.value().subtitle, "Subtitle") << "it may stand before the seconds, or after";
  run("title Title 2 \"a subtitle\"");
  EXPECT_EQ(p.title.value().subtitle, "a subtitle");
  run("highlight gibbs 1");
  EXPECT_EQ(window_.in_front(Side::right), panel_name::gibbs);
  run("orbit 90 3 10");
  run("fly-to 10 20 1.5 2");
  ASSERT_EQ(p.flights.size(), 2u);
  EXPECT_NEAR(p.left(), 4.5, 1e-12) << "motions follow one another";
  run("wait until done");
  EXPECT_NEAR(p.hold, 4.5, 1e-12);
  EXPECT_NEAR(p.pass(5.0, true), 4.5, 1e-12) << "no more than the script waits for";
  EXPECT_FALSE(p.holds());
  EXPECT_FALSE(p.title || p.highlight);
  EXPECT_EQ(p.caption.value().text, "one") << "it has no end";
  EXPECT_EQ(p.pass(3.0, true), 0) << "lines that do not wait take no time";
  run("wait 1");
  EXPECT_NEAR(p.pass(0, true), 0.5, 1e-12) << "the rest of the five seconds";
  run("caption two");
  EXPECT_EQ(p.leaving_caption.value().text, "one");
  EXPECT_EQ(p.caption.value().opacity(), 0) << "two at a time cannot be read";
}

TEST_F(CommandEffects, AssertionsCompareTheLastView) {
  for (const char* holds : {"assert views 2", "assert views = 2", "assert views >= 2", "assert views < 3",
                            "assert coverage > 0", "assert gibbs-views 0"})
    EXPECT_EQ(error_of(holds), "no error") << holds;
  EXPECT_EQ(error_of("assert views 3"), "views is 2, not = 3");
  EXPECT_EQ(error_of("assert views > 2"), "views is 2, not > 2");
  EXPECT_EQ(error_of("assert coverage <= 0.0001").substr(0, 11), "coverage is");
}

TEST_F(CommandEffects, ASliceStandsWhereItIsSaid) {
  const auto expect_slice = [&](int axis, double low, double high) {
    ASSERT_TRUE(window_.layers.voxels.slice);
    EXPECT_EQ(window_.layers.voxels.slice->axis, axis);
    EXPECT_NEAR(window_.layers.voxels.slice->low, low, 1e-12);
    EXPECT_NEAR(window_.layers.voxels.slice->high, high, 1e-12);
  };
  const VoxelGrid& grid = scan_.now().grid;
  run("slice-axis z");
  const double middle = (grid.lower().z() + grid.upper().z()) / 2;
  expect_slice(2, middle - grid.resolution, middle + grid.resolution);
  run("slice-axis y");
  EXPECT_EQ(window_.layers.voxels.slice->axis, 1);
  run("slice-at 0.05 0.2");
  expect_slice(1, -0.05, 0.15);
  run("slice-at -0.1");
  expect_slice(1, -0.2, 0.0);
  run("slice-axis none");
  EXPECT_FALSE(window_.layers.voxels.slice);
}

TEST_F(CommandEffects, SelectionFollowsItsRules) {
  Selection& s = window_.selection;
  s.ray = 3;
  run("select-view 4");
  EXPECT_TRUE(s.view.is(Kind::candidate, 4));
  EXPECT_FALSE(s.ray) << "a ray of another view";
  s.ray = 3;
  run("select-view 4");
  EXPECT_EQ(s.ray, 3u) << "a ray of the same view";
  run("select-taken 2");
  EXPECT_TRUE(s.view.is(Kind::taken, 1)) << "people count views from 1";
  EXPECT_FALSE(s.ray);
  EXPECT_EQ(error_of("select-taken 3"), "select-taken: 2 views were taken");
  EXPECT_EQ(error_of("select-view 8"), "select-view: there are 8 candidates, from 0");
  EXPECT_TRUE(s.view.is(Kind::taken, 1)) << "what failed changed something";
  s.ray = 3;
  run("inspect-voxel 0.01 -0.05 0.1");
  const VoxelGrid& grid = scan_.now().grid;
  EXPECT_LT((grid.centre(s.voxel.value()) - Vector3(0.01, -0.05, 0.1)).cwiseAbs().maxCoeff(), 0.5001 * grid.resolution);
  EXPECT_FALSE(s.ray);
  EXPECT_EQ(window_.in_front(Side::right), panel_name::inspector);
  EXPECT_THAT(error_of("inspect-voxel 5 0 0"), HasSubstr("outside of the region"));
  run("inspect-ray 7");
  EXPECT_EQ(s.ray, 7u);
  EXPECT_FALSE(s.voxel);
  run("select-next");
  EXPECT_TRUE(s.view == ViewSelection{});
  run("inspect-voxel 0 0 0");
  run("clear-selection");
  EXPECT_EQ(s, Selection{});
}

TEST_F(CommandEffects, AnCustomViewStandsWhereItIsSaidAndLooksThere) {
  run("custom-view 0.6 -0.5 0.4 0.1 0.2 0.3");
  const Vector3 from(0.6, -0.5, 0.4), to(0.1, 0.2, 0.3);
  const Pose pose = window_.selection.custom_view.value();
  EXPECT_LT((pose.translation() - from).norm(), 1e-12);
  EXPECT_LT((pose.linear().col(2) - (to - from).normalized()).norm(), 1e-9) << "z is forward";
  EXPECT_TRUE(window_.selection.view.is(Kind::custom, 0));
  EXPECT_EQ(window_.in_front(Side::right), panel_name::view);
  window_.scene_camera = look_at(Vector3(0.5, 0.4, 0.5), Vector3::Zero());
  run("custom-view");
  EXPECT_TRUE(window_.selection.custom_view->isApprox(window_.scene_camera));
  run("look-through");
  run("select-taken 1");
  run("look-through");
  run("look-from 30 20");
  run("zoom -2");
  run("frame");
  const auto& motions = window_.camera_motions;
  ASSERT_EQ(motions.size(), 5u);
  const auto through = [&](int i) { return std::get<camera_motion::LookThrough>(motions[i]).T_world_camera; };
  EXPECT_TRUE(through(0).isApprox(window_.scene_camera));
  EXPECT_TRUE(through(1).isApprox(scan_.now().records[0].T_world_camera));
  EXPECT_EQ(std::get<camera_motion::LookFrom>(motions[2]).azimuth, 30);
  EXPECT_EQ(std::get<camera_motion::LookFrom>(motions[2]).elevation, 20);
  EXPECT_EQ(std::get<camera_motion::Zoom>(motions[3]).steps, -2);
  EXPECT_TRUE(std::holds_alternative<camera_motion::Frame>(motions[4]));
}

}  // namespace
}  // namespace nextview
