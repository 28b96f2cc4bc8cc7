#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/evaluation/candidate_sight.hpp"
#include "core/evaluation/coverage.hpp"
#include "core/evaluation/visible_samples.hpp"
#include "core/map/bit_mask.hpp"
#include "core/map/ground_truth.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/progress/progress.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// How far a scan has come with a known object.
struct EvaluationState {
  std::vector<std::uint8_t> seen;  ///< one a surface sample, 1: a view would have seen it, but for noise
  SurfaceCoverage coverage;        ///< by the points of the views, at d_reg
  SurfaceCoverage coverage_paper;  ///< at the paper's
  BitMask visited_voxels;          ///< one per voxel: a noise-free ray visited it

  std::size_t bytes() const { return seen.size() + 2 * coverage.observed().size() + visited_voxels.memory(); }
};

/// What is known of an object whose mesh is known: for the evaluation, and for the baselines that may look at it
/// (oracle, covering order). Never changes.
class KnownObject {
 public:
  /// The paper's registration distance [m], reported beside the chosen one.
  static constexpr double paper_d_reg = 0.0005;

  /// `seen` is all that a camera sees, the object and what it stands on; `samples` are those of the object.
  /// @throws Stopped
  KnownObject(const TriangleMesh& seen, SurfaceSamples samples, std::shared_ptr<const MeshRayCaster> scene,
              const DepthCamera& camera, std::vector<Pose> candidates, const VoxelGrid& grid, double d_reg,
              const std::stop_token& stop);

  /// Surface samples that a perfect camera sees from a pose: in its image and ranges, not too slanted, nothing in
  /// between.
  /// @throws Stopped
  std::vector<std::uint32_t> samples_seen(const Pose& T_world_camera, const std::stop_token& stop = {}) const;

  /// One a sample, 1: a camera could see it from some pose, whatever the candidates are. Found when it is asked for
  /// first, which takes a second or two; from any thread. @throws Stopped; then the next who asks finds it.
  const std::vector<std::uint8_t>& seen_from_any_pose(const Progress& progress = {},
                                                      const std::stop_token& stop = {}) const;

  /// Before the first view.
  EvaluationState nothing_seen() const { return nothing_seen_; }
  /// A view was taken from here and gave these points. @throws Stopped; then some of it is added.
  void add_view(EvaluationState& state, const Pose& T_world_camera, const PointCloud& points,
                const std::stop_token& stop = {}) const;

  /// Those that the scan began with.
  std::span<const Pose> candidates() const { return candidates_; }
  /// What those candidates see: coverage_visible is a share of that. Found when it is asked for first, which takes a
  /// moment; from any thread. @throws Stopped; then the next who asks finds it.
  const CandidateSight& sight(const Progress& progress = {}, const std::stop_token& stop = {}) const;
  /// One per sample, 1: one of those candidates sees it. @throws as sight()
  std::span<const std::uint8_t> visible(const std::stop_token& stop = {}) const;
  /// What other candidates see. @throws Stopped
  CandidateSight sight_of(std::span<const Pose> candidates, const Progress& progress = {},
                          const std::stop_token& stop = {}) const;

  const GroundTruth& truth() const { return truth_; }
  const SurfaceSamples& samples() const { return samples_; }

 private:
  SampledSurface surface() const { return {samples_.points, normals_}; }

  std::shared_ptr<const MeshRayCaster> scene_;
  DepthCamera camera_;
  SurfaceSamples samples_;
  std::vector<Eigen::Vector3f> normals_;    ///< of the samples
  std::vector<std::uint32_t> all_samples_;  ///< their numbers
  std::vector<Pose> candidates_;
  GroundTruth truth_;
  EvaluationState nothing_seen_;
  mutable std::mutex finding_;
  mutable std::optional<CandidateSight> sight_;                ///< once it was asked for; so is the next
  mutable std::vector<std::uint8_t> visible_;                  ///< 1: some candidate sees the sample
  mutable std::optional<std::vector<std::uint8_t>> any_pose_;  ///< 1: some pose does
};

}  // namespace nextview
