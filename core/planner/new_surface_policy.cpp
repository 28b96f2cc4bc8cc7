#include "core/planner/new_surface_policy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/planner/remaining_plan.hpp"
#include "core/setting/area_text.hpp"

namespace nextview {
namespace {

/// On which side of the object most of a view's expected new surface lies; empty if it is spread around.
std::string side(std::span<const NewSurfaceInVoxel> voxels, const Vector3& centre) {
  constexpr double most = 0.6;
  constexpr std::array names = {"on its +x side", "on its -x side", "on its +y side",
                                "on its -y side", "at its top",     "at its bottom"};
  std::array<double, 6> shares{};  // beyond a third of the way from the centre to either side
  Vector3 reach = Vector3::Zero();
  double all = 0.0;
  for (const NewSurfaceInVoxel& voxel : voxels) {
    reach = reach.cwiseMax((voxel.middle - centre).cwiseAbs());
    all += voxel.area;
  }
  for (const NewSurfaceInVoxel& voxel : voxels) {
    const Vector3 at = voxel.middle - centre;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(at[axis]) > reach[axis] / 3) shares[2 * axis + (at[axis] < 0)] += voxel.area / all;
  }
  const auto largest = std::max_element(shares.begin(), shares.end());
  return *largest < most ? "" : names[static_cast<std::size_t>(largest - shares.begin())];
}

std::vector<Pose> poses(const PlanningState& state, std::span<const std::size_t> candidates) {
  std::vector<Pose> views;
  for (const std::size_t v : candidates) views.push_back(state.candidates[v].T_world_camera);
  return views;
}

}  // namespace

SurfaceEvidence surface_evidence(const Knowledge& known, const OpenBorder& border) {
  const OccupancyMap& map = known.map;
  return {map.grid(), known.planning_voxels(), map.voxels(), map.model().occupancy_threshold, border};
}

double promise_kept(std::span<const TakenView> taken) {
  constexpr double memory = 0.4;  // of a view, one view later
  constexpr double least = 0.02, most = 5.0;
  double kept = 1.0, found = 0.0, expected = 0.0;
  for (const TakenView& view : taken) {
    if (!(view.expected_new_surface > 0.0)) continue;
    const double as_modelled = view.expected_new_surface / kept;
    if (expected == 0.0) found = expected = as_modelled;  // as if one view before had kept its promise
    found = memory * found + view.new_surface;
    expected = memory * expected + as_modelled;
    kept = std::clamp(found / expected, least, most);
  }
  return kept;
}

double shown_over_expected(double surface_left) {
  struct Stage {
    double left, shown;
  };
  constexpr std::array stages = {Stage{0.01, 0.6}, Stage{0.04, 1.25}, Stage{0.3, 1.25}, Stage{0.7, 0.9}};
  const auto after = std::ranges::lower_bound(stages, surface_left, {}, &Stage::left);
  if (after == stages.begin()) return stages.front().shown;
  if (after == stages.end()) return stages.back().shown;
  const Stage& before = *std::prev(after);
  return std::lerp(before.shown, after->shown,
                   std::log(surface_left / before.left) / std::log(after->left / before.left));
}

std::shared_ptr<const NewSurfacePolicy::Seen> NewSurfacePolicy::see(const Knowledge& known) const {
  const auto is_of = [&](const Seen& seen) {
    return seen.planned_on.shares_all_with(known.planning_voxels()) &&
           seen.occlusions.shares_all_with(known.map.voxels()) && seen.scanned == known.scanned;
  };
  {
    const std::scoped_lock lock(seeing_);
    if (last_seen_ && is_of(*last_seen_)) return last_seen_;
    last_seen_.reset();  // before another takes as much memory
  }
  const OpenBorder border = open_border(known);
  const SurfaceEvidence evidence = surface_evidence(known, border);
  auto seen =
      std::make_shared<const Seen>(Seen{known.planning_voxels(), known.map.voxels(), known.scanned,
                                        evidence.object().center(), border.length, NewSurfaceField(evidence, model_)});
  const std::scoped_lock lock(seeing_);
  last_seen_ = seen;
  return seen;
}

Valuation NewSurfacePolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                   std::stop_token stop) const {
  const std::shared_ptr<const Seen> seen = see(state.known);
  NewSurfaceForecast forecast =
      forecast_new_surface(seen->field, poses(state, available), state.bundle, options(state), stop);
  const ScannedSurface* surface = state.known.scanned.get();
  const double scanned = surface ? model_.square_centimetres(surface->area()) : 0.0;
  if (!(scanned > 0.0)) return std::move(forecast.areas);
  SetCover few = covering_views(forecast, state.negligible_share * (forecast.all + scanned));
  for (std::size_t& view : few.views) view = available[view];
  // The forecast knows voxels; what is less than one of them shows where the scanned surface ends.
  const double strip = seen->border_length * surface->radius() / (model_.mean_slant * surface->area());
  const double at_border = std::min(1.0, model_.left_at_border * strip);
  const double left = std::max(forecast.all / (forecast.all + scanned), at_border);
  const double stage = shown_over_expected(left);
  for (double& area : forecast.areas) area *= stage;
  return {std::move(forecast.areas), left, std::move(few.views), few.is_least};
}

std::vector<double> NewSurfacePolicy::finer_values(const PlanningState& state, std::span<const std::size_t> candidates,
                                                   std::stop_token stop) const {
  if (!state.fine_bundle) return {};
  return expected_new_surface(see(state.known)->field, poses(state, candidates), *state.fine_bundle, options(state),
                              stop);
}

std::string NewSurfacePolicy::promise(double value, const PlanningState& state, const Pose& T_world_camera) const {
  std::string text = area_text(value) + " of new surface";
  if (!(value > 0.0)) return text;
  const std::shared_ptr<const Seen> seen = see(state.known);
  const std::string where =
      side(new_surface_in_voxels(seen->field, T_world_camera, state.bundle, options(state)), seen->object_centre);
  return where.empty() ? text : text + ", most of it " + where;
}

std::optional<ScoreExplanation> NewSurfacePolicy::explain(const PlanningState& state,
                                                          const Pose& T_world_camera) const {
  return explain_new_surface(see(state.known)->field, state.known.map.grid(), state.known.planning_voxels(),
                             T_world_camera, state.fine_bundle ? *state.fine_bundle : state.bundle, options(state));
}

}  // namespace nextview
