#pragma once
#include "core/source/scan_source.hpp"

namespace nextview {

/// Exercise: a source of its own. It sees the square |x|, |y| <= 0.2 m of the plane z = 0, without a mesh.
class PlaneSource : public ScanSource {
 public:
  PlaneSource() { description_.camera = PinholeCamera::from_field_of_view(40, 30, 1.0); }
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token) override {
    if (step == failing_step) return Failure{Failure::disconnected, "the cable is out"};
    DepthImage image{description_.camera, {}};
    for (int v = 0; v < image.camera.height; ++v)
      for (int u = 0; u < image.camera.width; ++u) {
        const Vector3 along = view.T_world_camera.linear() * image.camera.direction(u, v);
        const Vector3 from = view.T_world_camera.translation();
        const double range = -from.z() / along.z();
        const Vector3 met = from + range * along;
        const bool is_met = range > 0.0 && range < description_.max_range && met.head<2>().cwiseAbs().maxCoeff() < 0.2;
        image.range.push_back(is_met ? float(range) : DepthImage::beyond_range);
      }
    return Capture{std::move(image), view.T_world_camera, description_.max_range};
  }

  std::uint32_t failing_step = 0;

 private:
  SourceDescription description_;
};

}  // namespace nextview
