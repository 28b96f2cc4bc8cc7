#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "core/evaluation/coverage.hpp"
#include "core/map/ground_truth.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/planner/policy.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// Told how far a job has come, from 0 to 1, and what it is doing. Called from the thread that does the job.
using Progress = std::function<void(double fraction, std::string_view what)>;

/// What is known of an object whose mesh is known: for the evaluation, and for the baselines that may look at it
/// (oracle, covering order).
class KnownObject : public TrueSurface {
 public:
  /// The paper's registration distance [m], reported beside the chosen one.
  static constexpr double paper_d_reg = 0.0005;

  /// @throws Stopped
  KnownObject(const TriangleMesh& mesh, const RayScene& scene, const DepthCamera& camera,
              std::span<const Pose> candidates, const VoxelGrid& grid, std::size_t surface_samples, double d_reg,
              std::uint64_t seed, const Progress& progress, std::stop_token stop);

  /// Surface samples that a perfect camera sees from a pose: in its image and ranges, not too slanted, nothing in
  /// between.
  /// @throws Stopped
  std::vector<std::uint32_t> samples_seen(const Pose& T_world_camera, const std::stop_token& stop = {}) const;

  /// A view was taken from here and gave these points. @throws Stopped; then go_back helps.
  void add_view(const Pose& T_world_camera, const PointCloud& points, const std::stop_token& stop = {});
  /// What the views so far have seen, a flag a sample.
  struct Seen {
    std::vector<std::uint8_t> samples, covered, covered_paper;
  };
  Seen seen() const;
  void go_back(const Seen& seen);

  /// How many surface samples the candidate would see that no view has seen yet (the oracle's gain).
  std::size_t new_samples(std::size_t candidate) const override;
  /// The candidates in the order of a greedy set cover of the samples, the cover's own views shuffled, then the others.
  std::vector<std::size_t> covering_order(std::uint64_t seed) const override;

  const GroundTruth& truth() const { return truth_; }
  const SurfaceCoverage& coverage() const { return coverage_; }
  const SurfaceCoverage& coverage_paper() const { return coverage_paper_; }
  const SurfaceSamples& samples() const { return samples_; }
  std::span<const std::uint8_t> visible() const { return visible_; }  ///< one a sample, 1: some candidate sees it

 private:
  std::vector<std::vector<std::uint32_t>> see_from(std::span<const Pose> candidates, const Progress& progress,
                                                   std::stop_token stop) const;
  std::vector<std::uint8_t> seen_by_any() const;

  const RayScene& scene_;
  DepthCamera camera_;
  SurfaceSamples samples_;
  std::vector<Eigen::Vector3f> normals_;               ///< of the samples
  std::vector<std::vector<std::uint32_t>> seen_from_;  ///< of each candidate
  std::vector<std::uint8_t> visible_;                  ///< 1: some candidate sees the sample
  std::vector<std::uint8_t> seen_;                     ///< 1: a view taken has seen the sample
  GroundTruth truth_;
  SurfaceCoverage coverage_, coverage_paper_;
};

}  // namespace nextview
