#include <atomic>
#include <chrono>
#include <numeric>

#include "tests/unit/workbench/inspected_scan.hpp"
#include "ui/workbench/inspection_worker.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {
namespace {

using Kind = ViewSelection::Kind;

TEST(Inspection, AVoxelsHistoryEndsAtTheMap) {
  InspectedScan scan(scan_by("occlusion-aware"));
  for (int i = 0; i < 3; ++i) scan.step();
  const auto& voxels = *scan.now().voxels;
  std::size_t measured = 0;
  for (std::uint32_t v = 0; v < voxels.size(); v += voxels[v].measured ? 7 : 101) {
    const Selection selection = only_voxel(v);
    const VoxelInspection voxel = scan.look(selection).voxel.value();
    EXPECT_EQ(voxel.voxel, v);
    ASSERT_EQ(voxel.history.size(), 3u);
    ASSERT_EQ(voxel.rays.size(), 3u);
    EXPECT_EQ(voxel.history.back().probability, voxels[v].probability) << v;
    const auto& h = voxel.history;
    const bool any = std::any_of(h.begin(), h.end(), [](const VoxelUpdate& u) { return u.measured(); });
    EXPECT_EQ(any, voxels[v].measured) << v;
    for (std::size_t k = 0; k < h.size(); ++k) {
      const auto& rays = voxel.rays[k];
      const auto hits = std::size_t(std::count_if(rays.begin(), rays.end(), [](const VoxelRay& r) { return r.hit; }));
      EXPECT_LE(rays.size(), 60u);
      if (h[k].hits + h[k].misses <= 60) {
        EXPECT_EQ(hits, h[k].hits) << v;
        EXPECT_EQ(rays.size(), h[k].hits + h[k].misses) << v;
      }
    }
    EXPECT_FALSE(voxel.conditional) << "there is no Gibbs map";
    EXPECT_TRUE(voxel.trace.empty());
    measured += any;
  }
  EXPECT_GT(measured, 50u);
}

TEST(Inspection, TheConditionalSumsToOneAndItsRaysToTheOdds) {
  for (const std::string model : {"paper", "attenuation"}) {
    Configuration c = scan_by("occlusion-aware");
    for (Setting& s : settings(c))
      if (s.key == "gibbs.model") s.set(model);
    InspectedScan scan(c);
    for (int i = 0; i < 2; ++i) scan.step();
    scan.runner.refine(2, 40, job_control());
    const auto gibbs = scan.now().gibbs;
    std::size_t with_rays = 0, with_trace = 0;
    for (std::uint32_t v = 0; v < gibbs->voxels->size(); v += 13) {
      const Selection selection = only_voxel(v);
      const VoxelInspection voxel = scan.look(selection).voxel.value();
      ASSERT_TRUE(voxel.conditional);
      const FullConditional& f = *voxel.conditional;
      EXPECT_NEAR(std::accumulate(f.probability.begin(), f.probability.end(), 0.0), 1.0, 1e-12);
      double log_odds = f.log_prior_odds;
      for (const RayEvidence& ray : f.rays) log_odds += ray.log_ratio;
      const double p = f.probability.at(std::size_t(f.level)), free = f.probability[0];
      if (p > 1e-12 && free > 1e-12) {
        EXPECT_NEAR(std::log(p / free), log_odds, 1e-9 * std::max(1.0, std::abs(log_odds)));
      }
      with_rays += !f.rays.empty();
      if (voxel.trace.empty()) continue;
      ++with_trace;
      ASSERT_EQ(voxel.trace.size(), 2u) << "one per chain";
      EXPECT_EQ(voxel.trace[0].size(), voxel.trace[1].size());
      for (std::size_t chain = 0; chain < 2; ++chain)
        EXPECT_EQ(voxel.trace[chain].back(), gibbs->posterior->states[chain][v]) << v << ": it does not end at its map";
    }
    EXPECT_GT(with_rays, 20u);
    EXPECT_GT(with_trace, 5u);
  }
}

TEST(Inspection, ATakenViewShowsWhatItMeasured) {
  InspectedScan scan(scan_by("occlusion-aware"));
  for (int i = 0; i < 2; ++i) scan.step();
  for (const std::size_t taken : {0u, 1u}) {
    const ViewInspection view = scan.look_at({Kind::taken, taken});
    EXPECT_TRUE(view.T_world_camera.isApprox(scan.now().records[taken].T_world_camera));
    EXPECT_EQ(view.explanation, nullptr);
    EXPECT_FALSE(view.no_explanation.empty());
    ASSERT_EQ(view.measured.size(), view.expected.depth.size());
    ASSERT_EQ(view.measured.size(), std::size_t(view.expected.columns) * view.expected.rows);
  }
  EXPECT_TRUE(scan.look_at({Kind::candidate, 0}).measured.empty());
  EXPECT_TRUE(scan.look_at({}).measured.empty());
}

/// Each depth, sent back along its cell's ray from where the view was taken, is at a point that was measured.
TEST(Inspection, MeasuredDepthFitsThePose) {
  InspectedScan scan(scan_by("occlusion-aware"));
  for (int i = 0; i < 3; ++i) scan.step();
  const SessionSnapshot& s = scan.now();
  for (std::size_t taken = 0; taken < 3; ++taken) {
    const ViewInspection view = scan.look_at({Kind::taken, taken});
    const auto& hits = s.scans[taken]->hits;
    const ExpectedView& cells = view.expected;
    const double cell_width = double(s.camera.width) / cells.columns,
                 cell_height = double(s.camera.height) / cells.rows;
    std::size_t seen = 0;
    double longest = 0;
    for (int row = 0; row < cells.rows; ++row)
      for (int column = 0; column < cells.columns; ++column) {
        const float depth = view.measured[std::size_t(row) * cells.columns + column];
        if (depth < 0) continue;
        ++seen;
        const Vector3 along = s.camera.direction((column + 0.5) * cell_width - 0.5, (row + 0.5) * cell_height - 0.5);
        const Vector3 point = s.records[taken].T_world_camera * Vector3(along * (depth / along.z()));
        double nearest = 1e9;
        for (const auto& r : hits) nearest = std::min(nearest, (r.cast<double>() - point).norm());
        longest = std::max(longest, nearest);
      }
    EXPECT_GT(seen, 100u);
    const double pixel = 0.5 * s.records[taken].T_world_camera.translation().norm() / s.camera.fx;
    EXPECT_LT(longest, 3 * pixel) << "view " << taken;
  }
}

/// Where the map says that a surface is, what is measured there agrees within some voxels.
TEST(Inspection, ExpectedAndMeasuredDepthAgreeWhereItWasSeen) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  const ViewInspection view = scan.look_at({Kind::taken, 0});
  std::size_t both = 0, near = 0;
  for (std::size_t i = 0; i < view.measured.size(); ++i) {
    if (view.measured[i] < 0 || view.expected.depth[i] < 0) continue;
    ++both;
    near += std::abs(view.measured[i] - view.expected.depth[i]) < 2.5 * scan.now().grid.resolution;
  }
  EXPECT_GT(both, 100u);
  EXPECT_GT(double(near), 0.9 * double(both));
}

TEST(Inspection, WhatIsNotThereIsNotInspected) {
  InspectedScan scan(scan_by("occlusion-aware"));
  Inspector none;
  const Inspection empty = none.inspect(std::make_shared<SessionSnapshot>(), {});
  EXPECT_FALSE(empty.view || empty.voxel);
  scan.step();
  Selection selection;
  for (const ViewSelection view : {ViewSelection{Kind::candidate, 8},
                                   {Kind::candidate, 1'000'000},
                                   {Kind::taken, 1},
                                   {Kind::taken, std::size_t(-1)},
                                   {Kind::custom, 0}}) {
    selection.view = view;
    EXPECT_FALSE(scan.look(selection).view);
    EXPECT_FALSE(selected_view_pose(scan.now(), selection));
  }
  selection.view = {};
  selection.ray = 1'000'000;
  for (const std::uint32_t voxel : {std::uint32_t(scan.now().grid.voxel_count()), std::uint32_t(-1)}) {
    selection.voxel = voxel;
    const Inspection inspection = scan.look(selection);
    EXPECT_FALSE(inspection.voxel);
    EXPECT_TRUE(inspection.view);
    EXPECT_EQ(inspection.selection, selection);
  }
  while (scan.runner.can_step()) scan.step();
  EXPECT_FALSE(scan.look({}).view) << "there is no next view";
}

TEST(Inspection, CountsAndKnowsItsSession) {
  InspectedScan scan(scan_by("occlusion-aware"));
  EXPECT_EQ(scan.look({}).number, 1u);
  const Inspection second = scan.look({});
  EXPECT_EQ(second.number, 2u);
  EXPECT_EQ(second.session, scan.runner.snapshot());
}

/// What cannot be looked at ends no program that holds a scan.
TEST(InspectionWorker, GoesOnAfterAFailure) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  auto broken = std::make_shared<SessionSnapshot>(scan.now());
  broken->scans.clear();
  Selection taken;
  taken.view = {Kind::taken, 0};
  InspectionWorker worker;
  const auto wait = [&] {
    while (worker.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  worker.ask(broken, taken);
  wait();
  EXPECT_EQ(worker.answer()->session, nullptr) << "there is no answer";
  worker.ask(scan.runner.snapshot(), taken);
  wait();
  EXPECT_EQ(worker.answer()->session, scan.runner.snapshot());
}

TEST(InspectionWorker, AnswersTheLatestQuestion) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  std::atomic<int> news = 0;
  InspectionWorker worker([&] { ++news; });
  EXPECT_EQ(worker.answer()->number, 0u);
  Selection selection;
  for (std::size_t v = 0; v < 8; ++v) {
    selection.view = {Kind::candidate, v};
    worker.ask(scan.runner.snapshot(), selection);
  }
  while (worker.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(worker.answer()->selection, selection);
  EXPECT_GT(news, 0);
  worker.ask(scan.runner.snapshot(), {});  // ends while it works
}

}  // namespace
}  // namespace nextview
