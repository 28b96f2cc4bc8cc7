#pragma once
#include <octomap/OcTree.h>

#include <memory>
#include <string_view>

#include "tests/benchmarks/planning_step.hpp"

namespace nextview {

/// Where a ray that met nothing ends for those who let longer rays than the range carve, and shorter ones hit.
Eigen::Vector3f beyond_range(const Scan& scan, const Eigen::Vector3f& miss);

/// A planning step of OctoMap's own calls, on one thread as they are.
class OctomapStep {
 public:
  explicit OctomapStep(const PlanningStep& step);
  /// `discretised`: one ray for all points in a voxel, which misses some voxels, and inner nodes updated at the end.
  void insert(const Scan& scan, bool discretised);
  /// Occlusion-aware, with castRay, computeRayKeys and search.
  double score(const PlanningStep& step) const;
  std::size_t occupied(const VoxelGrid& grid) const;

 private:
  octomap::OcTree tree_, discretised_tree_;
};

/// The step's map as a NanoVDB grid (Museth 2021), which is read only: scored by its DDA with a cached accessor, on all
/// threads.
class NanoVdbMap {
 public:
  explicit NanoVdbMap(const OccupancyMap& map);
  ~NanoVdbMap();
  double score(const PlanningStep& step) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

/// Embree, asked ray by ray (rtcIntersect1), on all threads.
class SingleRays {
 public:
  explicit SingleRays(const TriangleMesh& mesh);
  ~SingleRays();
  /// Distances along the step's image rays from its next view; how many of them met the object.
  std::size_t cast(const Vector3& origin, std::span<const Eigen::Vector3f> directions, float max_range) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// A map of others that need not be there (NEXTVIEW_PEERS in CMakeLists.txt). It has seen the views before, and holds
/// the next scan as it takes it: to bring it into that form is not timed.
class MapPeer {
 public:
  virtual ~MapPeer() = default;
  virtual std::string_view insertion() const = 0;  ///< what is called
  virtual void insert() = 0;
  virtual std::string_view scoring() const { return {}; }  ///< empty: it is not scored
  virtual double score(const PlanningStep&) const { return 0.0; }
  /// Voxels of the grid: whether it does what others do.
  virtual std::size_t occupied(const VoxelGrid& grid) const = 0;
};

/// Those that were built, in the order of the table: each one's file adds it.
using MakePeer = std::unique_ptr<MapPeer> (*)(const PlanningStep& step);
std::vector<MakePeer>& peer_makers();
template <class Peer>
bool add_peer() {
  peer_makers().push_back(
      [](const PlanningStep& step) -> std::unique_ptr<MapPeer> { return std::make_unique<Peer>(step); });
  return true;
}

}  // namespace nextview
