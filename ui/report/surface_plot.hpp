#pragma once
#include <functional>
#include <string>

#include "ui/report/plot.hpp"

namespace nextview {

/// A function of two variables as a surface over their plane, coloured by its value.
struct SurfacePlot {
  std::string title, note;
  std::string x_label, y_label, z_label;  ///< with their units
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  double z_high = 1.0;  ///< of its axis, which begins at 0
  std::function<double(double x, double y)> value;
  int steps = 48;  ///< along either side
};
void draw_surface_plot(VectorDrawing& drawing, const DrawingArea& area, const SurfacePlot& plot);

}  // namespace nextview
