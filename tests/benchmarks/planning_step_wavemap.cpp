#include <wavemap/core/integrator/measurement_model/continuous_ray.h>
#include <wavemap/core/integrator/projection_model/pinhole_camera_projector.h>
#include <wavemap/core/integrator/projective/coarse_to_fine/hashed_chunked_wavelet_integrator.h>
#include <wavemap/core/map/hashed_chunked_wavelet_octree.h>
#include <wavemap/core/utils/query/query_accelerator.h>

#include <cmath>

#include "tests/benchmarks/planning_step_peers.hpp"
#include "tests/benchmarks/planning_step_walk.hpp"

namespace nextview {
namespace {

/// What its wavelets leave where nobody has measured is less.
constexpr float noise = 1e-3f;
/// OctoMap's bounds.
const float free_at_most = std::log(0.12f / 0.88f), occupied_at_most = std::log(0.97f / 0.03f);

wavemap::Transformation3D transformation(const Pose& pose) {
  const Pose::LinearMatrixType rotation = pose.linear();
  return wavemap::Transformation3D(wavemap::Rotation3D(Eigen::Quaternionf(Eigen::Quaterniond(rotation).cast<float>())),
                                   pose.translation().cast<float>());
}

/// Its quickest, and what its authors advise: cells are projected into the image of depths, coarse ones where all of
/// them is free or behind, the blocks of the map on all threads.
class WaveletPeer final : public MapPeer {
  auto reader() const {
    using Look = wavemap::QueryAccelerator<wavemap::HashedChunkedWaveletOctree>;
    return [this] {
      return [look = Look(*map_)](int x, int y, int z) mutable {
        const float log_odds = look.getCellValue(wavemap::Index3D(x, y, z));
        return std::abs(log_odds) < noise ? 0.5 : 1.0 / (1.0 + std::exp(-log_odds));
      };
    };
  }

 public:
  explicit WaveletPeer(const PlanningStep& step)
      : map_(std::make_shared<wavemap::HashedChunkedWaveletOctree>(wavemap::HashedChunkedWaveletOctreeConfig(
            float(step.map.grid().resolution), free_at_most, occupied_at_most, 6, 5.0f))),
        integrator_(integrator(step)),
        next_(image(step, PlanningStep::next_view)) {
    for (const int view : PlanningStep::views_before()) insert(image(step, view));
  }

  std::string_view insertion() const override { return "wavemap: chunked wavelet octree (all threads)"; }
  std::string_view scoring() const override { return "wavemap: DDA, QueryAccelerator (all threads)"; }
  void insert() override { insert(next_); }
  double score(const PlanningStep& step) const override { return best_score(step, reader()); }
  std::size_t occupied(const VoxelGrid& grid) const override { return occupied_voxels(grid, reader()); }

 private:
  using Image = wavemap::PosedImage<>;

  std::unique_ptr<wavemap::IntegratorBase> integrator(const PlanningStep& step) const {
    const PinholeCamera& camera = step.camera.camera();
    const auto projector = std::make_shared<wavemap::PinholeCameraProjector>(wavemap::PinholeCameraProjectorConfig(
        float(camera.fx), float(camera.fy), float(camera.cx), float(camera.cy), camera.height, camera.width));
    const auto ranges = std::make_shared<Image>(projector->getDimensions());
    const auto offsets = std::make_shared<wavemap::Image<wavemap::Vector2D>>(projector->getDimensions());
    // The deviation makes the surface as thick as the others have it (half a voxel, as its authors advise, a quarter
    // less); the scales make a miss 0.4 and a hit 0.7, as OctoMap's are.
    const wavemap::ContinuousRayConfig ray(0.75f * map_->getMinCellWidth(), 0.2f, 0.4f);
    return std::make_unique<wavemap::HashedChunkedWaveletIntegrator>(
        wavemap::ProjectiveIntegratorConfig(map_->getMinCellWidth(), float(PlanningStep::max_range)), projector, ranges,
        offsets, std::make_shared<wavemap::ContinuousRay>(ray, projector, ranges), map_);
  }

  /// Depths along z, as its cameras give them; 0 where nothing was measured.
  static Image image(const PlanningStep& step, int view) {
    const Scan scan = step.sense(view);
    const Pose at = step.view(view), to_camera = at.inverse();
    const PinholeCamera& camera = step.camera.camera();
    Image image(transformation(at), camera.width, camera.height, 0.0f);
    const auto set = [&](const Eigen::Vector3f& point, bool hit) {
      const Vector3 p = to_camera * point.cast<double>();
      const Eigen::Vector2d pixel = camera.project(p);
      // What is farther than the range carves all along it.
      const double depth = hit ? p.z() : 2.0 * PlanningStep::max_range;
      image.at({int(std::lround(pixel.x())), int(std::lround(pixel.y()))}) = float(depth);
    };
    for (const auto& p : scan.hits) set(p, true);
    for (const auto& p : scan.misses) set(p, false);
    return image;
  }
  void insert(const Image& image) {
    integrator_->integrate(image);
    map_->threshold();  // cells above the finest are not kept within their bounds before
  }

  wavemap::HashedChunkedWaveletOctree::Ptr map_;
  std::unique_ptr<wavemap::IntegratorBase> integrator_;
  Image next_;
};

const bool added = add_peer<WaveletPeer>();

}  // namespace
}  // namespace nextview
