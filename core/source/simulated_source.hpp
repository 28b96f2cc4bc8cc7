#pragma once
#include <memory>

#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// An object, and the ground if it stands on one, in front of a simulated depth camera.
struct SimulatedWorld {
  std::shared_ptr<const PlacedMesh> object;
  MeshRayCaster scene;
  DepthCamera camera;

  /// @throws std::invalid_argument if the sensor's configuration is not valid; Stopped
  SimulatedWorld(std::shared_ptr<const PlacedMesh> placed, const DepthCameraConfig& sensor,
                 const std::stop_token& stop = {});
};

/// Scans of a simulated world: the same view, step and seed give the same bytes.
class SimulatedSource : public ScanSource {
 public:
  SimulatedSource(std::shared_ptr<const SimulatedWorld> world, std::uint64_t seed);
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override;

 private:
  std::shared_ptr<const SimulatedWorld> world_;
  std::uint64_t seed_;
  SourceDescription description_;
};

}  // namespace nextview
