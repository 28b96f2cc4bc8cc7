#include "ui/window/scene_view.hpp"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "ui/layers/ray_segments.hpp"

namespace nextview {
namespace {

/// Enough to tell where the view's rays go and what they are worth, few enough to see what is behind them.
constexpr std::size_t rays_shown = 60;
/// Candidates that may be taken next, for all that anybody needs to see of them.
constexpr std::size_t best_shown = 5;

/// Of each candidate: it is neither taken, nor looked at, nor among the best.
std::vector<bool> hidden_candidates(const SessionSnapshot& s, const Selection& selection) {
  std::vector<bool> hidden(s.candidates.size(), true);
  const std::vector<Candidate> ranked = s.records.empty() ? std::vector<Candidate>() : s.records.back().candidates;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    hidden[i] = !s.state.known.has_taken(s.state.candidates[i]);
    if (ranked[i].available) order.push_back(i);
  }
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return ranked[i].utility; });
  if (!s.finished.empty()) order.clear();
  for (std::size_t k = 0; k < std::min(order.size(), best_shown); ++k) hidden[order[k]] = false;
  const auto next = s.finished.empty() ? s.next_candidate : std::nullopt;
  for (const auto& looked_at : {next, selection.candidate()})
    if (looked_at && *looked_at < hidden.size()) hidden[*looked_at] = false;
  return hidden;
}

bool same(const LayerChoice& a, const LayerChoice& b) {
  const auto shown = [](const LayerChoice& c) {
    return std::tuple(c.object, c.cloud, c.octree, c.views, c.rays, c.region, c.missed, c.all_candidates, c.legends,
                      c.object_style, c.cloud_colouring, c.map, c.colouring, c.ranges_locked, c.surface,
                      c.surface_colouring);
  };
  return shown(a) == shown(b) && a.voxels == b.voxels && a.section == b.section;
}

/// The explanation of the view that is looked at, if it is known.
std::shared_ptr<const ScoreExplanation> explanation_of(const SessionSnapshot& s, const Selection& selection,
                                                       const Inspection& inspection) {
  if (selection.view.kind == ViewSelection::Kind::next) return s.explanation;
  const bool answered = inspection.view && inspection.view->view == selection.view && inspection.session &&
                        inspection.session->session == s.session;
  return answered ? inspection.view->explanation : nullptr;
}

}  // namespace

SceneView::SceneView(RenderTarget& target, double scale) : target_(target), scale_(scale) {
  scene_.attach(target);
  scene_.set_scale(scale);
  scene_.set_backed(true);
  scene_.set_legends_to_come(true);
}

void SceneView::set_scale(double scale) { scene_.set_scale(scale_ = scale); }

void SceneView::place(const Rectangle& rectangle) {
  rectangle_ = rectangle;
  Rectangle drawn = rectangle;  // at least a pixel: what is not drawn at all has no framebuffer to compose from
  drawn.x = std::min(drawn.x, target_.width() - 1.0);
  drawn.y = std::min(drawn.y, target_.height() - 1.0);
  drawn.width = std::max(drawn.width, 1.0);
  drawn.height = std::max(drawn.height, 1.0);
  const Viewport viewport = drawn.in(target_.width(), target_.height());
  renderer().SetViewport(viewport.left, viewport.bottom, viewport.right, viewport.top);
  const Vector3 room(drawn.width, drawn.height, scale_);
  if (std::exchange(annotated_in_, room) != room) scene_.annotate();
}

std::array<Rectangle, 2> SceneView::beside_legends() const {
  const Rectangle& r = rectangle_;
  const Eigen::Vector2d reach = scale_ * scene_.legends_reach();
  const double left = std::max(r.width - reach.x(), 0.0), lower = std::max(r.height - reach.y(), 0.0);
  return {{{r.x, r.y, left, r.height}, {r.x + left, r.y + r.height - lower, r.width - left, lower}}};
}

/// What is to be drawn anew, and why.
struct SceneView::Changes {
  bool ground, projection, session, snapshot, map, choice, section, surface, rays, doubt;
  bool selection;  ///< of a view, or of where the scene is looked at from, if a view is from there

  bool much() const { return ground || projection || surface || snapshot || choice || doubt; }
  bool none() const { return !much() && !rays && !selection; }
};

SceneChange SceneView::show(std::shared_ptr<const SessionSnapshot> snapshot, const WindowState& window,
                            std::shared_ptr<const Inspection> inspection, std::shared_ptr<const DoubtfulScan> doubtful,
                            std::shared_ptr<const FoundSurface> surface) {
  const bool new_ground = dark_ != window.dark, new_projection = orthographic_ != window.orthographic;
  if (new_ground) scene_.set_dark(dark_ = window.dark);
  if (new_projection) scene_.set_orthographic(orthographic_ = window.orthographic, pivot_);
  if (!snapshot->loaded()) return new_ground ? SceneChange::much : SceneChange::none;
  if (doubtful_ && doubtful != doubtful_) leave_doubtful();
  const SessionSnapshot& s = *snapshot;
  const LayerChoice& choice = window.layers;
  const auto explanation = explanation_of(s, window.selection, *inspection);
  const auto eye = eye_of_a_view(s, window);
  const bool new_session = !shown_ || shown_->session != s.session;
  const Changes is_new{.ground = new_ground,
                       .projection = new_projection,
                       .session = new_session,
                       .snapshot = shown_ != snapshot,
                       .map = new_session || shown_->map != s.map,
                       .choice = !same(choice, choice_),
                       .section = choice.section != choice_.section,
                       .surface = surface != surface_ || new_session || choice.surface != choice_.surface ||
                                  choice.surface_colouring != choice_.surface_colouring,
                       .rays = explanation != explanation_,
                       .doubt = doubtful != doubtful_,
                       .selection = selection_.candidate() != window.selection.candidate() || eye != eye_ ||
                                    selection_.custom_view.has_value() != window.selection.custom_view.has_value()};
  if (is_new.none()) return SceneChange::none;

  surface_ = std::move(surface);
  show_what_is_there(s, choice, is_new);
  const bool new_views = is_new.selection || is_new.snapshot || is_new.ground ||
                         choice.ranges_locked != choice_.ranges_locked ||
                         choice.all_candidates != choice_.all_candidates;
  explanation_ = explanation;
  keep_ranges_ = choice.ranges_locked && choice_.ranges_locked;
  choice_ = choice;
  eye_ = eye;
  if (const auto pose = selected_view_pose(s, window.selection); is_new.rays || is_new.snapshot || is_new.ground)
    show_rays(s, s.finished.empty() && pose ? explanation.get() : nullptr,
              pose ? pose->translation() : Vector3(Vector3::Zero()));
  if (new_views) show_views(s, window);
  doubtful_ = std::move(doubtful);
  set_visible(s, choice);
  shown_ = std::move(snapshot);
  selection_ = window.selection;
  if (is_new.session) move(camera_motion::Frame{});
  if (is_new.doubt && doubtful_) show_doubtful(s);
  renderer().ResetCameraClippingRange();
  return is_new.much() ? SceneChange::much : SceneChange::little;
}

/// The region, the object, and what the scans have made of it.
void SceneView::show_what_is_there(const SessionSnapshot& s, const LayerChoice& choice, const Changes& is_new) {
  if (is_new.session) scene_.region().show({s.grid.lower(), s.grid.upper()});
  if (is_new.session || is_new.ground || choice.object_style != choice_.object_style)
    scene_.mesh().show(s.mesh ? *s.mesh : TriangleMesh{}, choice.object_style);
  if (choice.missed && (is_new.ground || s.missed != missed_)) show_missed(s);
  cloud_is_old_ |=
      is_new.map || choice.cloud_colouring != choice_.cloud_colouring || choice.ranges_locked != choice_.ranges_locked;
  if (choice.cloud && std::exchange(cloud_is_old_, false)) show_cloud(s, choice);
  voxels_are_old_ |= is_new.map || choice.map != choice_.map || choice.voxels != choice_.voxels || is_new.section;
  colours_are_old_ |= voxels_are_old_ || choice.colouring != choice_.colouring;
  if (is_new.surface) show_surface(s, choice);
  if (is_new.section) scene_.cut(choice.section);
  if (is_new.section || is_new.surface || is_new.session || is_new.ground ||
      (choice.object || choice.missed) != (choice_.object || choice_.missed))
    show_section(s, choice);
  if (choice.octree && std::exchange(colours_are_old_, false)) show_voxels(s, choice);
}

void SceneView::show_views(const SessionSnapshot& s, const WindowState& window) {
  ViewsPicture picture;
  std::vector<double> utilities;
  std::vector<std::size_t> taken, unreachable;
  std::vector<Pose> path;
  for (const StepRecord& record : s.records) path.push_back(record.T_world_camera);
  for (std::size_t v = 0; v < s.state.candidates.size(); ++v)
    if (s.state.known.has_taken(s.state.candidates[v])) taken.push_back(v);
  ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  if (!s.records.empty()) {
    for (const Candidate& candidate : s.records.back().candidates) {
      if (!candidate.unreachable.empty()) unreachable.push_back(utilities.size());
      utilities.push_back(candidate.utility);
      if (!candidate.available) continue;
      range = {std::min(range.first, candidate.utility), std::max(range.second, candidate.utility)};
    }
  }
  const bool keep = keep_ranges_ && shown_ && shown_->session == s.session && utilities_.first < utilities_.second;
  if (!keep) utilities_ = range;
  hidden_ = hidden_candidates(s, window.selection);
  if (choice_.all_candidates) hidden_.assign(s.candidates.size(), false);
  std::vector<std::size_t> hidden;
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    if (hidden_[i]) hidden.push_back(i);
  picture.hidden = hidden;
  picture.camera = s.camera;
  picture.candidates = s.candidates;
  picture.scores = utilities;
  picture.taken = taken;
  picture.unreachable = unreachable;
  picture.path = path;
  picture.numbered_path = true;
  picture.score_name = "utility";
  if (choice_.ranges_locked && utilities_.first < utilities_.second) picture.range = utilities_;
  if (s.finished.empty()) {
    picture.chosen = s.next_candidate;
    if (s.custom_next_view) picture.custom_view = s.next_view;
  }
  const Vector3 target = 0.5 * (s.grid.lower() + s.grid.upper());
  picture.eye = eye_;
  picture.size = frustum_depth(s.candidates, target);
  picture.reach = (s.next_view.translation() - target).norm();
  scene_.views().show(picture);
}

std::optional<Vector3> SceneView::eye_of_a_view(const SessionSnapshot& s, const WindowState& window) {
  if (window.orthographic) return std::nullopt;  // the camera is at no place
  const Vector3 eye = camera_pose().translation();
  const double depth = frustum_depth(s.candidates, 0.5 * (s.grid.lower() + s.grid.upper()));
  const auto is_here = [&](const Pose& T_world_camera) { return stands_at(eye, T_world_camera.translation(), depth); };
  const bool here = std::any_of(s.candidates.begin(), s.candidates.end(), is_here) || is_here(s.next_view) ||
                    (window.selection.custom_view && is_here(*window.selection.custom_view)) ||
                    std::any_of(s.records.begin(), s.records.end(),
                                [&](const StepRecord& record) { return is_here(record.T_world_camera); });
  return here ? std::optional(eye) : std::nullopt;
}

void SceneView::show_rays(const SessionSnapshot& s, const ScoreExplanation* explanation, const Vector3& origin) {
  rays_.clear();
  if (explanation) rays_ = ray_segments(*explanation, origin, s.grid.resolution, rays_shown);
  double most = 0;
  for (const RaySegment& ray : rays_) most = std::max(most, ray.value);
  if (!keep_ranges_ || max_contribution_ <= 0) max_contribution_ = most;
  RayValues values{"contribution of a ray", s.gain_unit};
  if (choice_.ranges_locked && max_contribution_ > 0) values.high = max_contribution_;
  scene_.rays().show(rays_, values);
}

void SceneView::set_visible(const SessionSnapshot& s, const LayerChoice& choice) {
  const bool usual = !doubtful_;
  const bool missed = choice.missed && s.missed;
  scene_.mesh().set_visible(usual && choice.object && s.mesh && !missed);
  scene_.missed().set_visible(usual && missed);
  scene_.surface().set_visible(usual && shown_surface());
  scene_.section().set_visible(usual && choice.section);
  scene_.cloud().set_visible(usual && choice.cloud);
  scene_.octree().set_visible(usual && choice.octree);
  scene_.views().set_visible(usual && choice.views);
  scene_.rays().set_visible(usual && choice.rays);
  scene_.region().set_visible(usual && choice.region);
  scene_.fit().set_visible(!usual);
  scene_.set_legends(choice.legends);
  scene_.annotate();
}

}  // namespace nextview
