#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/gain/ray_lanes.hpp"
#include "core/map/occupancy.hpp"
#include "core/view/pinhole_camera.hpp"

namespace nextview {

/// Two readings of the literature, selectable everywhere. `published`: visibility is the product of (1 - p), rays are
/// clipped to the region of interest. `reference`: what the code of Isler et al. 2016 and Delmerico et al. 2018
/// computes (visibility is the product of p).
enum class Semantics { published, reference };

/// A voxel on a ray as a gain sees it.
struct RayVoxel : Voxel {
  bool has_node = false;                  ///< an octree has a node here, measured or not
  std::array<std::int16_t, 3> lattice{};  ///< voxel n spans [n, n+1) * resolution along each axis
};

struct Gain;

/// What the voxels of a map are worth to a gain, and how far rays go in it.
struct WorthOfMap {
  VoxelGrid grid;
  double max_range;  ///< [m]
  StateField field;
};

/// Tells which voxels a ray visits: v_0 ... v_N, up to the first measured voxel with p >= the occupancy threshold, or
/// to the maximum range.
class RayCaster {
 public:
  virtual ~RayCaster() = default;
  /// `direction` is of unit length. `visited` is overwritten. Safe to call from several threads.
  virtual void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const = 0;
  /// The same rays through what the voxels are worth to a gain (Gain::worth), for rays in lanes; none where they must
  /// be cast one by one.
  virtual std::optional<WorthOfMap> worth_of_map(const Gain&, double /*occlusion_reach*/) const { return std::nullopt; }
};

/// The rays that score a view: unit directions in the camera frame, through a regular grid of its pixels.
struct RayBundle {
  std::vector<Vector3> directions;
  std::vector<double> solid_angles;  ///< of each ray's part of the image [sr]

  /// `columns` x `rows` rays through the middles of equal cells of the image, or of its middle: `window` is the share
  /// of width and height.
  static RayBundle regular(const PinholeCamera& camera, int columns = 38, int rows = 25, double window = 1.0);
  /// The bundle of the reference code: pixel x from `lowest` to `highest` share of the width inclusive, one every
  /// `spacing` pixels, truncated to whole pixels; y likewise.
  static RayBundle reference(const PinholeCamera& camera, Eigen::Vector2d lowest, Eigen::Vector2d highest,
                             Eigen::Vector2d spacing);
};

}  // namespace nextview
