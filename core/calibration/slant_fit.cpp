#include "core/calibration/slant_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

namespace nextview {

SurfaceSlant fit_slant(const NewSurfaceModel& model, std::span<const ShownByViews> shown) {
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  Eigen::Vector2d met = Eigen::Vector2d::Zero();
  for (const ShownByViews& some : shown) {
    const NewSurfaceField field(some.evidence, model);
    const auto areas = [&](SurfaceSlant slant) {
      return expected_new_surface(field, some.views, some.bundle, {some.ray_length, slant});
    };
    // What is expected is linear in both slants.
    const std::vector<double> edge_on = areas({1.0, 0.0}), face_on = areas({0.0, 1.0});
    for (std::size_t v = 0; v < some.views.size(); ++v) {
      const Eigen::Vector2d share = Eigen::Vector2d(edge_on[v], face_on[v]) / some.surface;
      expected += share * share.transpose();
      met += some.areas[v] / some.surface * share;
    }
  }
  if (!(expected.determinant() > 0.0)) throw std::invalid_argument("new surface: no view is expected to show any");
  const Eigen::Vector2d fitted = expected.ldlt().solve(met);
  const auto slant = [](double value) { return std::clamp(value, SurfaceSlant::least, SurfaceSlant::most); };
  return {slant(fitted[0]), slant(fitted[1])};
}

}  // namespace nextview
