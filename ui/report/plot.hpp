#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ui/report/vector_drawing.hpp"

namespace nextview {

/// A rectangle of a drawing [px], y down.
struct DrawingArea {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct PlotSeries {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> spread = {};  ///< a band of so much above and below, one a value or none
  Colour colour = theme::series[0];
  double thickness = 2.0;
  bool dashed = false;
  bool joined = true;  ///< a line; else dots alone
};

/// A plot's title, in as many lines as it needs; returns how much lower what is beneath it lies than beneath one line.
double draw_plot_title(VectorDrawing& drawing, const DrawingArea& area, const std::string& title);

/// Curves over two axes, each named at its right end: told apart by place, not by colour alone.
struct Plot {
  std::string title;
  std::string x_label, y_label;  ///< with their units
  std::vector<PlotSeries> series;
  std::optional<double> x_low, x_high, y_low, y_high;  ///< of the axes; else the data's
  bool logarithmic_y = false;
  bool whole_x = false;   ///< x counts something
  bool diagonal = false;  ///< y = x, dashed
};
void draw_plot(VectorDrawing& drawing, const DrawingArea& area, const Plot& plot);

/// Values beside each other, a row each, with their spread: in the order given.
struct DotPlot {
  std::string title, label;  ///< of the values, with their unit
  struct Row {
    std::string name;
    double value = 0.0, spread = 0.0;
    bool strong = false;
  };
  std::vector<Row> rows;
  std::vector<std::pair<double, std::string>> marks;  ///< vertical lines, named
};
void draw_dot_plot(VectorDrawing& drawing, const DrawingArea& area, const DotPlot& plot);

/// Numbers in cells, shaded by their value.
struct MatrixPlot {
  std::string title, note;
  std::vector<std::string> rows, columns;
  std::vector<std::vector<std::optional<double>>> values;  ///< [row][column]; none: an empty cell
  int digits = 1;
  bool dark_is_high = true;
  bool diverging = false;           ///< from blue over grey to red, instead of from light to dark
  std::optional<double> low, high;  ///< of the shades; else the values'
};
/// In which its names and numbers do not run into each other [px].
double least_width(const MatrixPlot& plot);
void draw_matrix(VectorDrawing& drawing, const DrawingArea& area, const MatrixPlot& plot);

}  // namespace nextview
