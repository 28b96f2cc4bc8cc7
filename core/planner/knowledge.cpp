#include "core/planner/knowledge.hpp"

#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {
namespace {

/// A map of the reference semantics casts its own rays, as long as its parameters say.
class ReferenceRays : public RayCaster {
 public:
  explicit ReferenceRays(std::shared_ptr<const ReferenceMap> map) : map_(std::move(map)) {}
  void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const override {
    map_->cast(origin, direction, visited);
  }

 private:
  std::shared_ptr<const ReferenceMap> map_;
};

}  // namespace

FusionSeconds fuse(Knowledge& known, const Scan& scan, const FusionConfig& config, const Progress& progress,
                   const std::stop_token& stop) {
  FusionSeconds seconds;
  Knowledge after = known;
  {
    Stopwatch watch(seconds.insert);
    after.map.insert(scan, config.insertion, stop);  // M <- update octree map M by measurement z
    if (config.occlusion_distance > 0.0) after.map.mark_occlusions(scan, config.occlusion_distance, stop);
    if (after.reference) {
      auto reference = after.reference->copy();
      reference->insert(scan.origin, scan.hits, stop);
      after.reference = std::move(reference);
    }
  }
  if (after.posterior) {
    Stopwatch watch(seconds.refine);
    auto posterior = std::make_shared<GibbsState>(*after.posterior);
    posterior->add(scan);
    const auto report_sampler = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
      if (progress) progress(fraction, what);
    };
    posterior->refine(&after.map.voxels(), config.view_sweeps, report_sampler, stop);
    throw_if_stopped(stop);
    after.posterior = std::move(posterior);
  }
  known = std::move(after);
  return seconds;
}

std::unique_ptr<RayCaster> planning_rays(const Knowledge& known, double ray_length) {
  if (known.reference) return std::make_unique<ReferenceRays>(known.reference);
  return std::make_unique<MapRays>(known.map.grid(), known.planning_voxels(), known.map.model().occupancy_threshold,
                                   ray_length);
}

}  // namespace nextview
