#include "ui/figures/step_figure.hpp"

#include <fmt/format.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <cmath>
#include <numbers>

#include "ui/drawing/painter.hpp"
#include "ui/figures/ranking.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

struct Panel {
  double x, y, width, height;  ///< [px]

  Viewport in(const RenderTarget& target) const {
    return {x / target.width(), y / target.height(), (x + width) / target.width(), (y + height) / target.height()};
  }
};

/// Two 3D views above, the ranking and the two curves beneath, a title line at the top.
struct StepLayout {
  Panel views, map, ranking, entropy, coverage;
  double title_y;

  explicit StepLayout(const RenderTarget& target) {
    constexpr double gap = 16, title = 64;
    const double width = target.width(), height = target.height();
    const double column = std::floor((width - 4 * gap) / 3);
    const double lower = std::floor(0.31 * height), upper = height - title - lower - 2 * gap;
    const double third = 3 * gap + 2 * column;
    views = {gap, lower + 2 * gap, 2 * column + gap, upper};
    map = {third, lower + 2 * gap, column, upper};
    ranking = {gap, gap, column, lower};
    entropy = {2 * gap + column, gap, column, lower};
    coverage = {third, gap, column, lower};
    title_y = height - 44;
  }
};

/// What lies beneath the panels: the title line and the panels' frames.
class Sheet : public vtkContextItem {
 public:
  static Sheet* New();
  vtkTypeMacro(Sheet, vtkContextItem)

      bool Paint(vtkContext2D* context) override {
    Painter painter(*context);
    painter.text(16, title_y, title, theme::title, theme::ink, TextWeight::semi_bold);
    painter.text(width - 16, title_y, subtitle, theme::caption, theme::soft_ink, TextWeight::regular, TextAlign::right);
    for (const Panel& panel : panels) {
      painter.frame(panel.x - 1, panel.y - 1, panel.width + 2, panel.height + 2, theme::hairline);
    }
    return true;
  }

  std::string title, subtitle;
  double title_y = 0, width = 0;
  std::vector<Panel> panels;
};

vtkStandardNewMacro(Sheet);

}  // namespace

struct StepFigure::Parts {
  explicit Parts(RenderTarget& where) : target(where), layout(where) {}

  RenderTarget& target;
  StepLayout layout;
  vtkNew<vtkRenderer> sheet_renderer;
  vtkNew<vtkContextActor> sheet_actor;
  vtkNew<Sheet> sheet;
  vtkNew<RankingItem> ranking;
  Scene views, map;
  Chart entropy, coverage;
};

StepFigure::StepFigure(RenderTarget& target) : parts_(std::make_unique<Parts>(target)) {
  Parts& p = *parts_;
  p.sheet_renderer->SetBackground(theme::paper.data());
  p.sheet_renderer->AddActor(p.sheet_actor);
  p.sheet_actor->GetScene()->SetRenderer(p.sheet_renderer);
  p.sheet_actor->GetScene()->AddItem(p.sheet);
  p.sheet_actor->GetScene()->AddItem(p.ranking);
  p.sheet->title_y = p.layout.title_y;
  p.sheet->width = target.width();
  p.sheet->panels = {p.layout.views, p.layout.map, p.layout.ranking, p.layout.entropy, p.layout.coverage};
  p.ranking->x = p.layout.ranking.x;
  p.ranking->y = p.layout.ranking.y;
  p.ranking->width = p.layout.ranking.width;
  p.ranking->height = p.layout.ranking.height;
  target.window().AddRenderer(p.sheet_renderer);
  p.views.attach(target, p.layout.views.in(target));
  p.map.attach(target, p.layout.map.in(target));
  p.entropy.attach(target, p.layout.entropy.in(target));
  p.coverage.attach(target, p.layout.coverage.in(target));
}

StepFigure::~StepFigure() {
  parts_->sheet_actor->GetScene()->SetRenderer(nullptr);
  parts_->target.window().RemoveRenderer(parts_->sheet_renderer);
}

void StepFigure::show(const StepPicture& picture) {
  Parts& p = *parts_;
  ViewDirection direction = picture.direction.value_or(ViewDirection{});
  if (!picture.direction && picture.chosen) direction = beside(picture.candidates.at(*picture.chosen));
  p.sheet->title = step_title(picture);
  p.sheet->subtitle = picture.reason.empty() ? picture.object_name : picture.object_name + " · " + picture.reason;

  p.views.set_caption("Candidate views");
  if (picture.object) p.views.mesh().show(*picture.object, picture.object_style);
  p.views.cloud().show(picture.cloud, picture.point_size);
  p.views.rays().show(picture.rays, picture.ray_values);
  p.views.views().show(views_of(picture));
  p.views.region().show({picture.grid.lower(), picture.grid.upper()});
  p.views.frame(direction);

  p.map.set_caption("Occupancy map");
  p.map.octree().show(picture.grid, picture.voxels);
  p.map.frame(direction);

  std::vector<std::size_t> not_ranked = picture.taken;
  not_ranked.insert(not_ranked.end(), picture.unreachable.begin(), picture.unreachable.end());
  p.ranking->content = {"Best candidates", picture.gain_name, picture.gain_unit, picture.scores,
                        picture.utilities, not_ranked,        picture.chosen,    picture.ranking_note};
  p.entropy.show(picture.entropy);
  p.coverage.show(picture.coverage);
}

Image draw_step_figure(const StepPicture& picture, int width, int height) {
  OffscreenTarget target(width, height);
  StepFigure figure(target);
  figure.show(picture);
  target.render();
  return target.read_back();
}

ViewsPicture views_of(const StepPicture& picture) {
  ViewsPicture views;
  views.camera = picture.camera;
  views.candidates = picture.candidates;
  views.scores = picture.scores;
  views.taken = picture.taken;
  views.unreachable = picture.unreachable;
  views.numbered = picture.numbered;
  views.chosen = picture.chosen;
  views.path = picture.path;
  views.score_name = picture.gain_name;
  views.score_unit = picture.gain_unit;
  const Vector3 target = 0.5 * (picture.grid.lower() + picture.grid.upper());
  views.size = frustum_depth(picture.candidates, target);
  if (picture.chosen) {
    views.reach = (picture.candidates.at(*picture.chosen).translation() - target).norm();
  }
  return views;
}

ViewDirection beside(const Pose& T_world_camera) {
  const Vector3 backwards = -T_world_camera.linear().col(2);
  return {std::atan2(backwards.y(), backwards.x()) * 180 / std::numbers::pi + 65, 22};
}

std::string step_title(const StepPicture& picture) {
  std::string title = fmt::format("Step {}", picture.step);
  if (picture.step_count > 0) title += fmt::format(" of {}", picture.step_count);
  if (!picture.finished.empty()) title += " · finished: " + picture.finished;
  if (!picture.chosen) return title;
  title += fmt::format(" · next best view {}", *picture.chosen);
  if (*picture.chosen < picture.scores.size()) {
    title += fmt::format(" · {} {}", picture.gain_name, short_text(picture.scores[*picture.chosen], picture.gain_unit));
  }
  return title;
}

}  // namespace nextview
