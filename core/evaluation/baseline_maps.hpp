#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Maps that must stand beside the Gibbs map: what simpler rules make of the same rays. In all of them each voxel is on
/// its own; they differ in what they make of the rays that ended in it (hits) and that passed through it (misses).
enum class BaselineMap { octomap, per_ray, no_clamps, hit_ratio, beta_binomial };

struct BaselineMapInfo {
  BaselineMap map;
  std::string_view name;
  std::string_view description;
};

/// All of them, to loop over.
inline constexpr std::array<BaselineMapInfo, 5> baseline_maps = {{
    {BaselineMap::octomap, "octomap", "the conventional map: one hit or miss a voxel and scan, clamped"},
    {BaselineMap::per_ray, "per-ray", "the conventional map's terms, one per voxel and ray, clamped after each"},
    {BaselineMap::no_clamps, "no-clamps", "the conventional map without clamps"},
    {BaselineMap::hit_ratio, "hit-ratio", "share of a voxel's rays that ended in it"},
    {BaselineMap::beta_binomial, "beta-binomial",
     "a voxel is free, with few false hits, or stops an unknown share of its rays"},
}};

/// What the rays say of one voxel. Rays are taken as OccupancyMap::insert takes them: those longer than the maximum
/// range, and scans' misses, end nowhere and carve up to it; hits outside of the grid carve only.
struct RayCounts {
  std::uint32_t hits = 0;         ///< rays that ended in it
  std::uint32_t misses = 0;       ///< rays that passed through it
  std::uint32_t scan_hits = 0;    ///< scans with a ray that ended in it
  std::uint32_t scan_misses = 0;  ///< scans with a ray that passed through it and none that ended in it

  bool any() const { return hits > 0 || misses > 0; }
};

/// hits / (hits + misses), with 0.05 hits in 0.1 rays more than there are: 0.5 where there are none.
double hit_ratio(const RayCounts& counts);

/// P(occupied | hits, misses) of a voxel that stops each ray with a probability of its own: a priori Beta(1, 999) if it
/// is free (false hits, 0.001 in the mean), Beta(1, 2) if it is occupied. Occupied a priori: 0.05. Misses without a hit
/// always speak for free; where rays are many, a voxel is called occupied if more than about 0.9 % of them end in it.
double beta_binomial(const RayCounts& counts);

/// Makes the baseline maps of one set of scans. The rays are counted once, for all of them.
class BaselineMaps {
 public:
  /// The scans must outlive this. Of the model `per_ray` uses the terms and clamps, `no_clamps`
  /// the terms, and all of them the bounds of the classes. Terms that depend on the range have, for rays as for scans,
  /// that from the camera to the voxel's centre.
  /// @throws std::invalid_argument if the model is not valid or a scan's maximum range is not over 0.
  BaselineMaps(const VoxelGrid& grid, std::span<const Scan> scans, const InverseSensorModel& model = {});

  /// One voxel a voxel of the grid; where no ray went p is 0.5 and nothing is measured. `per_ray` depends on the order
  /// of the rays: scan after scan, in each the hits first.
  std::vector<Voxel> make(BaselineMap map) const;

  std::span<const RayCounts> counts() const { return counts_; }  ///< one per voxel of the grid

 private:
  void count_rays();
  std::vector<Voxel> octomap() const;
  std::vector<Voxel> per_ray() const;
  double update_term(const Scan& scan, std::uint32_t voxel, bool is_hit) const;
  std::vector<Voxel> no_clamps() const;
  /// Gives each voxel that a ray visited the probability `p_of(voxel)`.
  template <class Probability>
  std::vector<Voxel> visited_voxels(Probability p_of) const;

  VoxelGrid grid_;
  std::span<const Scan> scans_;
  InverseSensorModel model_;
  std::vector<RayCounts> counts_;
};

}  // namespace nextview
