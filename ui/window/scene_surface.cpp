// The reconstructed surface, and what a section lays open.
#include <algorithm>

#include "ui/window/scene_view.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

constexpr double per_mm = 1e3;

std::vector<float> in_mm(std::span<const float> metres) {
  std::vector<float> result(metres.begin(), metres.end());
  for (float& value : result) value *= float(per_mm);
  return result;
}

/// The largest uncertainty of what was seen, but for a hundredth of it [m].
double usual_uncertainty(const Surface& surface) {
  std::vector<float> of_seen;
  for (std::size_t i = 0; i < surface.uncertainty.size(); ++i)
    if (surface.seen[i]) of_seen.push_back(surface.uncertainty[i]);
  if (of_seen.empty()) return 0.0;
  const auto place = of_seen.begin() + std::ptrdiff_t(0.99 * double(of_seen.size() - 1));
  std::nth_element(of_seen.begin(), place, of_seen.end());
  return *place;
}

}  // namespace

const TriangleMesh* SceneView::shown_surface() const {
  const bool shown = choice_.surface && surface_ && surface_->of.session && shown_ &&
                     surface_->of.session->session == shown_->session && !surface_->found.surface.empty();
  return shown ? &surface_->found.surface.mesh : nullptr;
}

void SceneView::show_surface(const SessionSnapshot& s, const LayerChoice& choice) {
  const bool of_it = choice.surface && surface_ && surface_->of.session && surface_->of.session->session == s.session;
  if (!of_it || surface_->found.surface.empty()) return scene_.surface().show(TriangleMesh{});
  const Surface& surface = surface_->found.surface;
  const auto& error = surface_->found.surface_error;
  const SurfaceColouring colouring = chosen_surface_colouring(s, choice);
  if (colouring == SurfaceColouring::by_deviation && error) {
    const std::vector<float> values = in_mm(error->at_vertices);
    const double limit = per_mm * error->histogram.limit;
    return scene_.surface().show(surface.mesh, MeshPaint{values, surface.seen, ColourMap::deviation(), -limit, limit,
                                                         "surface against truth", "mm", "inside", "outside"});
  }
  if (colouring != SurfaceColouring::single) {
    const std::vector<float> values = in_mm(surface.uncertainty);
    return scene_.surface().show(
        surface.mesh, MeshPaint{values, surface.seen, ColourMap::contribution(), 0.0,
                                per_mm * scale_end(usual_uncertainty(surface)), "uncertainty of the surface", "mm"});
  }
  scene_.surface().show(
      surface.mesh,
      MeshClasses{surface.seen, {{"not seen", theme::object}, {"reconstructed", theme::reconstructed}}, "surface"});
}

void SceneView::show_section(const SessionSnapshot& s, const LayerChoice& choice) {
  if (!choice.section) return scene_.section().clear();
  const bool object = (choice.object || choice.missed) && s.mesh;
  const TriangleMesh* surface =
      choice.surface && surface_ && surface_->of.session && surface_->of.session->session == s.session
          ? &surface_->found.surface.mesh
          : nullptr;
  scene_.section().show(*choice.section, object ? s.mesh.get() : nullptr, surface);
}

}  // namespace nextview
