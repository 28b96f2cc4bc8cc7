#include "core/calibration/slant_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

namespace nextview {

void SlantFit::add(const ShownByViews& shown) {
  const NewSurfaceField field(shown.evidence, model_);
  const auto areas = [&](const SurfaceSlant& slant) {
    return expected_new_surface(field, shown.views, shown.bundle, {shown.ray_length, slant});
  };
  const std::vector<double> edge_on = areas({1.0, 0.0}), face_on = areas({0.0, 1.0});
  for (std::size_t v = 0; v < shown.views.size(); ++v) {
    const Eigen::Vector2d share = Eigen::Vector2d(edge_on[v], face_on[v]) / shown.surface;
    expected_ += share * share.transpose();
    met_ += shown.areas[v] / shown.surface * share;
  }
}

SurfaceSlant SlantFit::fit() const {
  if (!(expected_.determinant() > 0.0)) throw std::invalid_argument("new surface: no view is expected to show any");
  const Eigen::Vector2d fitted = views_taken_show * expected_.ldlt().solve(met_);
  const auto slant = [](double value) { return std::clamp(value, SurfaceSlant::least, SurfaceSlant::most); };
  return {slant(fitted[0]), slant(fitted[1])};
}

}  // namespace nextview
