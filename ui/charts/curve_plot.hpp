#pragma once
#include <string>
#include <vector>

#include "ui/charts/page.hpp"

namespace nextview {

struct Curve {
  std::string name;
  std::vector<std::string> details;  ///< lines beneath the name, if the names stand beside the plot
  std::vector<double> x, y;          ///< as many of each; values that are not finite leave gaps
  Colour colour = theme::series[0];
};

/// Curves over given ranges, without a mark at each value, on a page. For what Chart does not draw: many values, a
/// logarithmic axis, bars, a marked part of the x axis. What is outside of the ranges is cut off.
struct CurvePlot {
  std::string title, remark;
  std::string x_label, y_label;  ///< with their units
  double x_low = 0.0, x_high = 1.0;
  double y_low = 0.0, y_high = 1.0;  ///< over 0 if logarithmic
  bool logarithmic_y = false;
  bool whole_x = false;      ///< x counts something: ticks at whole numbers only
  double names_width = 0.0;  ///< the curves' names stand in a column so wide beside the plot [px]; 0: in rows above it
  std::vector<Curve> curves;

  /// A part of the x axis that is tinted, its name at the top, or where curves are there at the bottom.
  struct Part {
    double from, to;
    std::string name;
    bool is_named_below = false;
  };
  std::vector<Part> parts;

  /// A column that stands on the x axis, behind the curves.
  struct Bar {
    double from, to, y;
    Colour colour;
  };
  std::vector<Bar> bars;
};

/// A panel with the plot and the curves' names.
/// @throws std::invalid_argument naming the curve if its x and y differ in number.
void paint_curve_plot(vtkContext2D& context, const PageArea& panel, const CurvePlot& plot);

}  // namespace nextview
