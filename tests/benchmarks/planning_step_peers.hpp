#pragma once
#include <octomap/OcTree.h>

#include <memory>

#include "tests/benchmarks/planning_step.hpp"

namespace nextview {

/// A planning step of OctoMap's own calls, on one thread as they are.
class OctomapStep {
 public:
  explicit OctomapStep(const PlanningStep& step);
  /// `discretised`: one ray for all points in a voxel, which misses some voxels, and inner nodes updated at the end.
  void insert(const Scan& scan, bool discretised);
  /// Occlusion-aware, with castRay, computeRayKeys and search.
  double score(const PlanningStep& step) const;

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

}  // namespace nextview
