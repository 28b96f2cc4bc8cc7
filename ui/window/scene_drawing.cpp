// When the scene is drawn, and with how much care.
#include <tbb/task_arena.h>

#include <algorithm>

#include "ui/window/interface_parts.hpp"

namespace nextview {
namespace {

/// The camera is at rest when it did not move for so long [s].
constexpr double rest = 0.15;
/// Likewise while a script goes on: its next line mostly comes before, and shows something else.
constexpr double rest_between_lines = 1.0;

}  // namespace

void Interface::Parts::follow_pointer(const PanelContext& context, double seconds) {
  if (pointer.follow(view, compared.rectangle(), context)) {
    camera_moved = true;
    if (!std::exchange(dragged, true)) motion_began = state.history.now;
    draw_fast(DrawingQuality::moving);
    return;
  }
  if (!script_goes_on()) motion_left = std::min(motion_left, rest);
  if (motion_left > 0 && (motion_left -= seconds) <= 0) {
    bring_to_rest();
    settling = frames_to_settle;  // what is under the pointer is looked up again
    if (std::exchange(dragged, false)) record_drag();
  }
}

/// Until nothing changes for a moment, the picture takes less care, so that it follows at once.
void Interface::Parts::draw_fast(DrawingQuality wanted) {
  scene_is_old = true;
  motion_left = script_goes_on() ? rest_between_lines : rest;
  quality = wanted;
  view.set_quality(quality);
  compared.set_quality(quality);
}

void Interface::Parts::bring_to_rest() {
  motion_left = 0;
  quality = DrawingQuality::still;
  view.set_quality(quality);
  compared.set_quality(quality);
  scene_is_old = true;
}

void Interface::Parts::move_camera() {
  for (const CameraMotion& motion : state.camera_motions) {
    view.move(motion);
    camera_moved = !std::holds_alternative<camera_motion::Frame>(motion) &&
                   !std::holds_alternative<camera_motion::LookFrom>(motion);
    if (!camera_moved) framing = motion;
    if (state.picture || (scripted && state.presentation.demo))
      bring_to_rest();
    else
      draw_fast(camera_moved && !scripted ? DrawingQuality::moving : DrawingQuality::coarse);
  }
  state.camera_motions.clear();
}

bool Interface::Parts::by_hand() const { return script.done() && !state.presentation.demo && !state.picture; }

/// And is not told to wait for a while, in which what it did is looked at.
bool Interface::Parts::script_goes_on() const { return !script.done() && !state.presentation.holds(); }

/// Returns whether it was drawn anew. Who works by hand sees at once what came of it; a script goes on at once, and
/// what it does is drawn well for a picture, and once it rests. All that a demo shows is drawn well.
bool Interface::Parts::draw_scene() {
  if (scene_waits) {
    scene_waits = faces.busy();
    view.take_faces(faces.found());
    if (!scene_waits) settling = frames_to_settle;  // the next frame shows it, however long they took
    return false;
  }
  SceneChange changed = SceneChange::none;
  // A frame that waits for its own loops must not help the session with its long ones.
  tbb::this_task_arena::isolate([&] {
    changed = view.show(news.snapshot, state, news.inspection, news.progress.doubtful, news.surface);
    changed = std::max(changed, compared.show(news.snapshot, state, news.surface));
  });
  const auto enough = changed == SceneChange::much ? DrawingQuality::coarse : DrawingQuality::quick;
  const bool rough = changed != SceneChange::none && !state.presentation.demo && !state.picture;
  if (rough && (motion_left <= 0 || quality < enough || script_goes_on()))
    draw_fast(motion_left > 0 ? std::max(quality, enough) : enough);
  scene_is_old |= changed != SceneChange::none;
  if (!scene_is_old) return false;
  compared.share_depth(view);
  target.render();
  ++scene_drawings;
  scene_is_old = false;
  return true;
}

}  // namespace nextview
