#pragma once
#include "ui/figures/scene_figure.hpp"
#include "ui/report/plot.hpp"
#include "ui/report/scan_figures.hpp"

namespace nextview {

/// Layers by name: nothing else is shown.
inline constexpr SceneLayers no_layers{false, false, false, false, false, false, false, false};

/// Around panels, between them, and above them for a figure's title [px].
inline constexpr double panel_margin = 16, panel_gap = 12, panel_top = 64;

/// A scene in a drawing. Where the object is not known its cloud stands in for it. With `points` [m, world] it shows
/// what is around these.
void draw_scene_panel(VectorDrawing& drawing, const DrawingArea& area, const StepPicture& picture,
                      const SceneLayers& layers, const FigurePaper& paper, const ViewDirection& direction = {},
                      std::span<const Vector3> points = {});
/// The session's step picture as it was after so many views, from 1; the session stands there afterwards.
StepPicture picture_after(ReportScan& scan, std::size_t views);
/// The object, or where it is not known the cloud, and with `view` the chosen view's frustum: to frame them.
std::vector<Vector3> points_around(const StepPicture& picture, bool view);
/// A heading above an area.
void draw_heading(VectorDrawing& drawing, const DrawingArea& area, const std::string& text);
/// A figure's title at its upper left.
void draw_title(VectorDrawing& drawing, const std::string& text);

/// What the colours of voxels mean, in a line from `top` on [px].
void draw_voxel_key(VectorDrawing& drawing, double top);

}  // namespace nextview
