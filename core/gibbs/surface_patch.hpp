#pragma once
#include <cstdint>
#include <vector>

#include "core/gibbs/ray_lists.hpp"
#include "core/map/bit_rows.hpp"

namespace nextview {

/// A plane through where rays end around a voxel, within the grid. Lengths are in voxel edges; the normal points away
/// from the cameras, into the object. All 0 if no ray ends near enough.
struct SurfacePatch {
  float ends = 0.0f;       ///< measured rays, those near the voxel's centre more
  float distance = 0.0f;   ///< of the plane behind the centre, along the normal; less than 0: the centre is inside
  float half = 0.0f;       ///< of the voxel's extent along the normal: the plane cuts the voxel if |distance| < half
  float roughness = 0.0f;  ///< standard deviation of the ends from the plane, without the sensor's noise
  float incidence = 0.0f;  ///< mean cosine between rays and normal; of a near patch without its sign
  /// Of a thin wall both sides are seen: the share of rays that come from behind it, and their plane's distance.
  float from_behind = 0.0f, distance_from_behind = 0.0f;
};

/// Where the rays of lists end, by voxel.
class RayEnds {
 public:
  RayEnds() = default;  ///< holds nothing, and may not be asked
  explicit RayEnds(const RayLists& lists);
  /// Through the ends in a voxel and in the 26 around it, nearer than `reach` to its centre.
  SurfacePatch patch(std::uint32_t voxel) const;
  /// Through the ends up to two voxels away: less sharp, and steadier where rays are few or noisy. Of a thin wall it is
  /// one plane through both sides, from_behind is not told, and which way the normal points may be a matter of
  /// rounding.
  SurfacePatch wide_patch(std::uint32_t voxel) const;

  static constexpr float reach = 1.5f;  ///< [voxel edges]

 private:
  struct End {
    Eigen::Vector3f at;  ///< from its voxel's centre [voxel edges]
    Eigen::Vector3f direction;
    float weight;  ///< measured rays
  };
  /// Of ends, each by its weight; places are from one centre [voxel edges].
  struct Sums {
    float weight = 0.0f;
    Eigen::Vector3f at = Eigen::Vector3f::Zero(), direction = Eigen::Vector3f::Zero();
    Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();  ///< at at^T, less what the sensor's noise adds

    void add(const End& end, const Eigen::Vector3f& place, float share, float variance);
    void add(const Sums& other, const Eigen::Vector3f& way, float share);  ///< `way`: from this centre to the other's
  };
  struct Plane {
    Eigen::Vector3f normal, through;  ///< from the voxel's centre
    float roughness;
  };
  static Plane plane_of(const Sums& sums);
  template <class Visit>
  void visit_around(std::uint32_t voxel, int cells, Visit visit) const;

  VoxelGrid grid_;
  float variance_ = 0.0f;                    ///< of a measured range [voxel edges^2]
  BitRows ended_, around_;                   ///< voxels that rays end in, and those up to two away from such a one
  std::vector<std::uint32_t> ended_before_;  ///< BitRows::counts_before of the first: numbers the places
  std::vector<std::uint32_t> begin_, end_;   ///< of each place's ends
  std::vector<Sums> sums_;                   ///< of each place, from its voxel's centre
  std::vector<End> ends_;
};

}  // namespace nextview
