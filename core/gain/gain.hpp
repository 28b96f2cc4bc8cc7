#pragma once
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/gain/ray.hpp"

namespace nextview {

/// How far behind a surface voxels are marked as occluded [m], where a scene does not say (Isler et al. 2016).
constexpr double default_occlusion_distance = 0.3;
/// d_max of proximity count [voxels]: twice as far as voxels of this edge [m] are marked [m].
constexpr double occlusion_reach(double distance, double resolution) { return 2.0 * distance / resolution; }

/// One ray as a gain sees it.
struct Ray {
  std::span<const RayVoxel> voxels;    ///< v_0 ... v_N
  std::span<const double> visibility;  ///< pi_0 ... pi_N: how likely the ray gets that far
  Semantics semantics = Semantics::published;
  double occlusion_reach = 60.0;  ///< d_max of proximity count [voxels]
};

/// What a gain adds up over the rays of one view: up to three sums, and what the reference's area factor carries from
/// ray to ray.
struct GainSums {
  std::array<double, 3> sum{};
  bool node_seen = false;
};

/// A gain's value for a view, and what one unit of each of its sums is worth: sum_k worth[k] * sums[k] == value.
struct GainValue {
  double value = 0.0;
  std::array<double, 3> worth{};
};

/// A volumetric information: a short function over the visited voxels of a ray.
struct Gain {
  std::string_view name;     ///< as on the command line and in the head of a column, e.g. "occlusion-aware"
  std::string_view unit;     ///< "nats", "nats/voxel", "voxels", or "" if it has none
  std::string_view summary;  ///< one line for people
  bool needs_occlusion;      ///< wants OccupancyMap::mark_occlusions
  bool needs_posterior;      ///< is of the Gibbs map, and has published semantics only

  /// What a voxel adds to the first sum, where it takes nothing but the voxel to tell; else null, as is the rest.
  double (*worth)(const Voxel& voxel, double occlusion_reach);
  bool weighs_visibility;  ///< ... times how likely the ray gets there

  /// Adds one ray to the sums of its view.
  void (*add_ray)(const Ray& ray, GainSums& sums);
  /// The value of a view whose rays have been added.
  GainValue (*value)(const GainSums& sums);
  /// What each voxel of a ray contributes to the view's value, given what its sums are worth. `sums` is as add_ray has
  /// it.
  void (*explain_ray)(const Ray& ray, GainSums& sums, const std::array<double, 3>& worth,
                      std::span<double> contribution);
};

/// Every gain that looks at single views, in the order of the columns of `nextview score`. 'combined' is made of these;
/// see combine().
std::span<const Gain> gains();

/// @throws std::invalid_argument naming the known gains.
const Gain& gain(std::string_view name);

/// The weights of the combined gain: a name of gains() and its weight.
struct WeightedGain {
  std::string_view name;
  double weight;
};

/// 'Pre-release, unconfirmed': 30 average entropy + 1 rear side entropy, from an early version of the authors' code.
/// The published weights are not available.
std::span<const WeightedGain> prerelease_weights();

/// The combined gain (Isler et al. 2016) of each view. published: sum_k w_k gain_k(v) / sum_v gain_k, a gain that is 0
/// everywhere adding 0; reference: sum_k w_k gain_k(v), normalised by its total over the views. `values[k][v]` belongs
/// to weights[k].
std::vector<double> combine(std::span<const double> weights, std::span<const std::vector<double>> values,
                            Semantics semantics);

}  // namespace nextview
