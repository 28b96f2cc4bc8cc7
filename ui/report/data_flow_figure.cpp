#include <algorithm>
#include <cmath>

#include "ui/report/scene_panel.hpp"

namespace nextview {
namespace {

constexpr double column = 212, row = 104, box_width = 148, box_height = 54;  // [px]
constexpr double left = 96, top = 96;                                        // of the first box's centre [px]

using Point = Eigen::Vector2d;

Point centre(const FlowBox& box) { return {left + box.x * column, top + box.y * row}; }

const FlowBox& box_of(const char* room) {
  return *std::ranges::find(flow_boxes(), std::string_view(room),
                            [](const FlowBox& b) { return std::string_view(b.room); });
}

/// Where the way between two centres leaves the first one's box.
Point border(const Point& from, const Point& to) {
  constexpr double space = 4;  // [px]
  const Point way = to - from;
  const double x = std::abs(way.x()) < 1e-9 ? INFINITY : (0.5 * box_width + space) / std::abs(way.x());
  const double y = std::abs(way.y()) < 1e-9 ? INFINITY : (0.5 * box_height + space) / std::abs(way.y());
  return from + std::min(x, y) * way;
}

void draw_arrow(VectorDrawing& d, const FlowArrow& arrow) {
  const Point a = centre(box_of(arrow.from)), b = centre(box_of(arrow.to));
  const Point start = border(a, b), end = border(b, a), way = (end - start).normalized(), side(-way.y(), way.x());
  const Colour& colour = d.look().soft_ink;
  d.line({start, end - 6 * way}, colour, 1.5);
  d.area({end, end - 9 * way + 4.5 * side, end - 9 * way - 4.5 * side}, colour);
  const Point middle = 0.5 * (start + end);
  const bool is_level = std::abs(way.y()) < 0.2;
  d.text(middle.x() + (is_level ? 0 : 10),
         middle.y() + (is_level                  ? -7
                       : std::abs(way.x()) > 0.2 ? 14
                                                 : 4),
         arrow.what, theme::small_text, colour, is_level ? TextAlign::centre : TextAlign::left);
}

}  // namespace

std::span<const FlowBox> flow_boxes() {
  static constexpr FlowBox boxes[] = {
      {"robot", "moves, says where it is", 0, 0},       {"source", "simulated, recorded, live", 1, 0},
      {"registration", "checks how scans fit", 2, 0},   {"cloud", "cleaned points (PCL)", 3, 0},
      {"planner", "utility, next best view", 0, 1},     {"gain", "rays, information", 1, 1},
      {"gibbs", "posterior of the map", 2, 1},          {"map", "log-odds (OctoMap)", 3, 1},
      {"journal", "captures, choices", 0, 2},           {"session", "Algorithm 2", 1, 2},
      {"evaluation", "coverage, D_KL, log loss", 2, 2}, {"surface", "meshes", 3, 2}};
  return boxes;
}

std::span<const FlowArrow> flow_arrows() {
  static constexpr FlowArrow arrows[] = {
      {"planner", "robot", "next view"}, {"robot", "source", "pose"},       {"source", "registration", "scan"},
      {"registration", "cloud", "scan"}, {"cloud", "map", "rays"},          {"cloud", "gibbs", "ranges"},
      {"map", "gibbs", "start"},         {"gibbs", "gain", "p(m)"},         {"gain", "planner", "gains"},
      {"map", "surface", "p(m)"},        {"surface", "evaluation", "mesh"}, {"evaluation", "session", "scores"},
      {"session", "journal", "steps"}};
  return arrows;
}

VectorDrawing data_flow_figure(std::span<ReportScan>, const FigurePaper& paper) {
  VectorDrawing d(2 * left + 3 * column, top + 2 * row + 60, paper.look);
  draw_title(d, "What flows through the program in a step");
  for (const FlowArrow& arrow : flow_arrows()) draw_arrow(d, arrow);
  for (const FlowBox& box : flow_boxes()) {
    const Point c = centre(box);
    const Colour colour = box.y == 0 ? theme::series[0] : box.y == 1 ? theme::series[2] : theme::series[3];
    d.box(c.x() - 0.5 * box_width, c.y() - 0.5 * box_height, box_width, box_height, d.look().on_paper(colour), 0.16);
    d.box(c.x() - 0.5 * box_width, c.y() - 0.5 * box_height, 4, box_height, d.look().on_paper(colour));
    d.text(c.x(), c.y() - 4, box.room, theme::text, d.look().ink, TextAlign::centre, true);
    d.text(c.x(), c.y() + 15, box.what, 11, d.look().soft_ink, TextAlign::centre);
  }
  return d;
}

}  // namespace nextview
