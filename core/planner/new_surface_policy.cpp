#include "core/planner/new_surface_policy.hpp"

#include <algorithm>
#include <array>

namespace nextview {
namespace {

/// On which side of the object most of a view's expected new surface lies; empty if it is spread around.
std::string side(const ScoreExplanation& explanation, const Vector3& centre, double resolution) {
  constexpr double most = 0.6;
  constexpr std::array names = {"on its +x side", "on its -x side", "on its +y side",
                                "on its -y side", "at its top",     "at its bottom"};
  std::array<double, 6> shares{};  // beyond a third of the way from the centre to either side
  Vector3 reach = Vector3::Zero();
  const auto offset = [&](const ScoreExplanation::Voxel& v) -> Vector3 {
    return (Vector3(v.lattice[0], v.lattice[1], v.lattice[2]) + Vector3::Constant(0.5)) * resolution - centre;
  };
  for (const auto& ray : explanation.rays)
    for (const auto& voxel : ray.voxels) reach = reach.cwiseMax(offset(voxel).cwiseAbs());
  for (const auto& ray : explanation.rays)
    for (const auto& voxel : ray.voxels)
      for (int axis = 0; axis < 3; ++axis)
        if (const double at = offset(voxel)[axis]; std::abs(at) > reach[axis] / 3)
          shares[2 * axis + (at < 0)] += voxel.contribution / explanation.value;
  const auto largest = std::max_element(shares.begin(), shares.end());
  return *largest < most ? "" : names[static_cast<std::size_t>(largest - shares.begin())];
}

}  // namespace

NewSurfaceField NewSurfacePolicy::field(const PlanningState& state) const {
  const OccupancyMap& map = state.known.map;
  return {{map.grid(), state.known.planning_voxels(), map.voxels(), map.model().occupancy_threshold}, model_};
}

std::vector<double> NewSurfacePolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                             std::stop_token stop) const {
  std::vector<Pose> views;
  for (const std::size_t v : available) views.push_back(state.candidates[v].T_world_camera);
  return expected_new_surface(field(state), views, state.bundle, options(state), stop);
}

std::string NewSurfacePolicy::promise(double value, const PlanningState& state, const Pose& T_world_camera) const {
  std::string text = short_text(value) + " cm² of new surface";
  if (!(value > 0.0)) return text;
  const OccupancyMap& map = state.known.map;
  const SurfaceEvidence evidence(map.grid(), state.known.planning_voxels(), map.voxels(),
                                 map.model().occupancy_threshold);
  const std::string where = side(*explain(state, T_world_camera), evidence.object().center(), map.grid().resolution);
  return where.empty() ? text : text + ", most of it " + where;
}

std::optional<ScoreExplanation> NewSurfacePolicy::explain(const PlanningState& state,
                                                          const Pose& T_world_camera) const {
  return explain_new_surface(field(state), state.known.map.grid(), state.known.planning_voxels(), T_world_camera,
                             state.bundle, options(state));
}

}  // namespace nextview
