#include "ui/workbench/inspector.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloud/evenly_kept.hpp"
#include "core/gibbs/full_conditional.hpp"
#include "core/session/scan_loop.hpp"
#include "ui/workbench/depth_cells.hpp"
#include "ui/workbench/view_sight.hpp"

namespace nextview {
namespace {

constexpr int expected_columns = 128;          ///< of the picture of a view
constexpr std::size_t max_rays_per_view = 60;  ///< through a voxel: more would only hide each other

/// Its level after each sweep, if the sampler kept it.
std::vector<std::vector<std::uint8_t>> trace_of(const GibbsPosterior& posterior, std::uint32_t voxel) {
  const auto& voxels = posterior.traces.voxels;
  const auto found = std::lower_bound(voxels.begin(), voxels.end(), voxel);
  std::vector<std::vector<std::uint8_t>> result;
  if (found == voxels.end() || *found != voxel) return result;
  const auto at = static_cast<std::size_t>(found - voxels.begin());
  for (const auto& chain : posterior.traces.levels) {
    result.emplace_back();
    for (const auto& sweep : chain) result.back().push_back(sweep[at]);
  }
  return result;
}

}  // namespace

Inspection Inspector::inspect(std::shared_ptr<const SessionSnapshot> session, const Selection& selection) {
  Inspection result{++count_, session, selection, {}, {}};
  if (!session->loaded()) return result;
  if (selected_view_pose(*session, selection)) result.view = inspect_view(*session, selection);
  if (selection.voxel && *selection.voxel < session->grid.voxel_count())
    result.voxel = inspect_voxel(*session, *selection.voxel);
  return result;
}

ViewInspection Inspector::inspect_view(const SessionSnapshot& s, const Selection& selection) const {
  ViewInspection view;
  view.view = selection.view;
  view.T_world_camera = *selected_view_pose(s, selection);
  const int rows = std::max(1, expected_columns * s.camera.height / s.camera.width);
  const double threshold = s.configuration.map.model.occupancy_threshold;
  const MapRays rays(s.grid, s.state.known.planning_voxels(), threshold, s.configuration.planner.ray_length);
  view.expected = expected_view(rays, view.T_world_camera, s.camera, expected_columns, rows);
  if (selection.view.kind == ViewSelection::Kind::taken) {
    view.measured = measured_depth(*s.scans.at(selection.view.index), view.T_world_camera, s.camera,
                                   view.expected.columns, view.expected.rows)
                        .depth;
    view.no_explanation = "This view has been taken: its gain was predicted on the map before it.";
  } else {
    view.why_empty = why_empty(s, view.T_world_camera);
    explain(s, view);
  }
  return view;
}

void Inspector::explain(const SessionSnapshot& s, ViewInspection& view) const {
  if (s.records.empty()) {
    view.no_explanation = "The start view is not ranked: nothing is known yet.";
  } else if (auto explanation = nextview::explain(*s.setup, s.state, view.T_world_camera)) {
    view.explanation = std::make_shared<const ScoreExplanation>(*std::move(explanation));
  } else {
    view.no_explanation = "'" + s.configuration.planner.gain + "' " + s.setup->planner->no_explanation() + ".";
  }
}

VoxelInspection Inspector::inspect_voxel(const SessionSnapshot& s, std::uint32_t voxel) const {
  VoxelInspection result;
  result.voxel = voxel;
  result.history = voxel_history(s.grid, s.configuration.map.model, s.scans, voxel);
  for (const auto& scan : s.scans)
    result.rays.push_back(evenly_kept(rays_through(s.grid, *scan, voxel), max_rays_per_view));
  if (s.gibbs && !s.gibbs->posterior->states.empty()) {
    result.conditional = full_conditional(s.grid, *s.gibbs->measurements, s.gibbs->config.model, s.gibbs->config.prior,
                                          s.gibbs->posterior->states.front(), voxel);
    result.trace = trace_of(*s.gibbs->posterior, voxel);
  }
  return result;
}

}  // namespace nextview
