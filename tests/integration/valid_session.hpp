#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ui/commands/script.hpp"
#include "ui/workbench/session_log.hpp"

namespace nextview {

inline void expect_record(const SessionSnapshot& s, std::size_t k) {
  const StepRecord& r = s.records[k];
  EXPECT_EQ(r.step, int(k) + 1);
  EXPECT_GE(r.view, -1);
  EXPECT_LT(r.view, int(s.candidates.size()));
  EXPECT_EQ(r.candidates.size(), s.candidates.size());
  EXPECT_TRUE(r.T_world_camera.matrix().allFinite());
  EXPECT_TRUE(std::isfinite(r.entropy) && std::isfinite(r.realised_gain) && std::isfinite(r.gain));
  EXPECT_TRUE(!r.ranking.best || *r.ranking.best < s.candidates.size());
  EXPECT_EQ(s.scans[k]->hits.size(), r.points);
}

inline void expect_gibbs(const SessionSnapshot& s) {
  if (!s.gibbs) return;
  EXPECT_LE(s.gibbs->views, s.records.size());
  EXPECT_GT(s.gibbs->views, 0u);
  EXPECT_EQ(s.gibbs->voxels->size(), s.grid.voxel_count());
  for (const Voxel& v : *s.gibbs->voxels) ASSERT_TRUE(v.probability >= 0 && v.probability <= 1);
}

/// What is true of every snapshot.
inline void expect_valid(const SessionSnapshot& s) {
  ASSERT_TRUE(s.loaded());
  ASSERT_TRUE(s.mesh && s.voxels && s.cloud);
  EXPECT_NO_THROW(s.configuration.validate());
  EXPECT_EQ(s.voxels->size(), s.grid.voxel_count());
  for (const Voxel& v : *s.voxels) ASSERT_TRUE(v.probability >= 0 && v.probability <= 1);
  EXPECT_EQ(s.cloud->points.size(), s.cloud->views.size());
  EXPECT_EQ(s.cloud->distances.size(), s.configuration.evaluation.enabled ? s.cloud->points.size() : 0);
  for (const std::uint16_t view : s.cloud->views) ASSERT_LT(view, s.records.size());
  ASSERT_EQ(s.scans.size(), s.records.size());
  EXPECT_LE(s.records.size(), std::size_t(s.configuration.termination.views));
  for (std::size_t k = 0; k < s.records.size(); ++k) expect_record(s, k);
  EXPECT_FALSE(s.candidates.empty());
  if (s.next_candidate) {
    EXPECT_LT(*s.next_candidate, s.candidates.size());
    EXPECT_TRUE(s.available(*s.next_candidate) || !s.finished.empty());
  }
  EXPECT_FALSE(s.next_candidate && s.custom_next_view);
  EXPECT_TRUE(s.next_view.matrix().allFinite());
  EXPECT_EQ(s.truth != nullptr, s.configuration.evaluation.enabled);
  EXPECT_EQ(s.missed != nullptr, s.configuration.evaluation.enabled);
  if (s.missed) {
    EXPECT_EQ(s.missed->observed.size(), s.missed->mesh->vertices.size());
  }
  EXPECT_TRUE(!s.earlier_runs || s.earlier_runs->size() <= 6u);
  EXPECT_EQ(s.message.find('\n'), std::string::npos) << s.message;
  expect_gibbs(s);
}

/// What is true of every state of the window.
inline void expect_valid(const WindowState& window, const SessionSnapshot& s) {
  const ViewSelection& view = window.selection.view;
  if (view.kind == ViewSelection::Kind::candidate) {
    EXPECT_LT(view.index, s.candidates.size());
  }
  if (view.kind == ViewSelection::Kind::taken) {
    EXPECT_LT(view.index, s.records.size());
  }
  if (view.kind == ViewSelection::Kind::custom) {
    EXPECT_TRUE(window.selection.custom_view);
  }
  if (window.selection.voxel) {
    EXPECT_LT(*window.selection.voxel, s.grid.voxel_count());
  }
  for (const Side side : {Side::left, Side::right, Side::bottom})
    EXPECT_EQ(panel_info(window.in_front(side)).side, side);
  if (const auto& slice = window.layers.voxels.slice) {
    EXPECT_TRUE(slice->axis >= 0 && slice->axis < 3);
    EXPECT_LE(slice->low, slice->high);
  }
  EXPECT_TRUE(window.camera_motions.empty());
  EXPECT_TRUE(window.scene_camera.matrix().allFinite());
  std::string script;
  for (const std::string& line : window.history.lines) script += line + "\n";
  EXPECT_NO_THROW(EXPECT_EQ(parse_script(script).size(), window.history.lines.size()));
}

/// Words that people are not to see.
inline void expect_words_for_people(const SessionLog::Entries& log) {
  for (const LogEntry& entry : log) {
    EXPECT_FALSE(entry.text.empty());
    if (entry.text.ends_with(", not nan") || entry.text.starts_with("the driver nan ")) continue;  // somebody wrote it
    for (const char* word : {"std::", "basic_", "bad_", "vector", "optional", "map::", "_M_", "nullptr", "\n", "stoi",
                             "assert", "Assertion", " nan", "variant", "stopped"})
      EXPECT_EQ(entry.text.find(word), std::string::npos) << entry.text;
  }
}

}  // namespace nextview
