#pragma once
#include <vtkSmartPointer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/drawing/viewport.hpp"

class vtkRenderer;

namespace nextview {

class RenderTarget;

struct ChartSeries {
  std::string name;
  std::vector<double> x, y;  ///< as many of each; values that are not finite leave gaps
  bool earlier = false;      ///< of an earlier run: pale, behind the others (panels only)
};

struct ChartContent {
  std::string title;
  std::string x_label, x_unit;  ///< a unit may be empty
  std::string y_label, y_unit;
  std::vector<ChartSeries> series;
  std::optional<double>
      y_high;           ///< upper end of the y axis; otherwise the data's. The y axis starts at 0, or below the data.
  bool whole_x = true;  ///< x counts something: ticks at whole numbers only
};

/// A line chart: title, axes with units, a legend if there are several series. The same in a window and in a figure.
class Chart {
 public:
  Chart();
  ~Chart();
  Chart(const Chart&) = delete;
  Chart& operator=(const Chart&) = delete;

  /// Draws into this part of the target from now on.
  void attach(RenderTarget& target, const Viewport& viewport = {});

  /// Pixels of the display a pixel of the design, 1 unless told otherwise: letters and lines become as much larger in
  /// what is shown from now on.
  void set_scale(double scale);

  /// @throws std::invalid_argument naming the series if its x and y differ in number.
  void show(const ChartContent& content);

 private:
  struct Parts;
  vtkSmartPointer<vtkRenderer> renderer_;
  std::unique_ptr<Parts> parts_;
};

/// Round numbers (1, 2 or 5 times a power of ten apart, and whole ones only if asked for) that cover [low, high], at
/// most about `count`.
std::vector<double> round_ticks(double low, double high, int count, bool whole);

}  // namespace nextview
