#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/offline/refinement.hpp"
#include "core/session/session.hpp"
#include "ui/render_target/render_target.hpp"
#include "ui/report/vector_drawing.hpp"

namespace nextview {

/// Both maps of a scan.
struct ReportMaps {
  RefinementJob job;
  Refinement refinement;
};

/// A scan that figures are drawn of.
struct ReportScan {
  std::string name;  ///< of the object
  std::unique_ptr<Session> session;
  std::vector<ScanState> states;  ///< after each view
  std::function<std::shared_ptr<const ReportMaps>()> maps = {};
};

/// What scans are drawn on, and how much of them.
struct FigurePaper {
  RenderTarget& target;  ///< scenes are drawn in it, one after the other: what it takes to draw is made once
  Look look;
  double scale = 1.0;      ///< pixels a pixel of the drawing; 0: scenes are left out, to see how large it is
  std::vector<int> views;  ///< columns of `strategy`, from 1; those that the scan does not have are left out
};

/// A figure that needs no study: of one scan or several.
struct ScanFigure {
  std::string name;
  std::string caption;                                                           ///< what it shows, and how it is read
  VectorDrawing (*draw)(std::span<ReportScan> scans, const FigurePaper& paper);  ///< @pre a view was taken in each scan
};
std::span<const ScanFigure> scan_figures();

VectorDrawing sensor_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing data_flow_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing scene_and_octree_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing candidate_views_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing strategy_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing maps_figure(std::span<ReportScan> scans, const FigurePaper& paper);
VectorDrawing gain_agreement_figure(std::span<ReportScan> scans, const FigurePaper& paper);

/// A box of the data flow, and the room that it is.
struct FlowBox {
  const char *room, *what;
  double x, y;  ///< of its centre, in columns and rows
};
struct FlowArrow {
  const char *from, *to, *what;  ///< that flows
};
std::span<const FlowBox> flow_boxes();
std::span<const FlowArrow> flow_arrows();

}  // namespace nextview
