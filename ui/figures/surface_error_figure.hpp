#pragma once
#include <string>

#include "core/evaluation/surface_error.hpp"
#include "core/surface/surface.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {

/// A reconstructed surface and what is said about it. The surface needs to live while it is drawn only.
struct SurfacePicture {
  std::string title;
  std::string remark;    ///< beside the title: how the surface came about
  std::string caption;   ///< one sentence: what is to be seen
  std::string openings;  ///< as summary() of its boundary loops says
  const Surface* surface = nullptr;
};

/// A reconstructed surface compared with the true one, as for a paper: painted by its signed distance, from three
/// sides; how the distances are spread; accuracy, completeness and what else sums it up. As large as the target; made
/// for 1600 x 1000 pixels.
/// @throws std::invalid_argument if there is no surface or the error is not one of it.
Image draw_surface_error_figure(RenderTarget& target, const SurfacePicture& picture, const SurfaceError& error);

/// The same of a surface whose truth nobody knows, by its uncertainty.
/// @throws std::invalid_argument if there is no surface or there is not for every vertex an uncertainty and a mark
///         whether it was seen.
Image draw_surface_figure(RenderTarget& target, const SurfacePicture& picture);

}  // namespace nextview
