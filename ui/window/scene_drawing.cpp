// When the scene is drawn, and with how much care.
#include <tbb/task_arena.h>

#include "ui/window/interface_parts.hpp"

namespace nextview {
namespace {

/// The camera is at rest when it did not move for so long [s].
constexpr double rest = 0.15;

}  // namespace

void Interface::Parts::follow_pointer(const PanelContext& context, double seconds) {
  if (pointer.follow(view, compared.rectangle(), context)) {
    camera_moved = true;
    if (!std::exchange(dragged, true)) motion_began = state.history.now;
    draw_fast(DrawingQuality::moving);
  } else if (motion_left > 0 && (motion_left -= seconds) <= 0) {
    bring_to_rest();
    settling = frames_to_settle;  // what is under the pointer is looked up again
    if (std::exchange(dragged, false)) record_drag();
  }
}

/// Until nothing changes for a moment, the picture takes less care, so that it follows at once.
void Interface::Parts::draw_fast(DrawingQuality quality) {
  scene_is_old = true;
  motion_left = rest;
  view.set_quality(quality);
  compared.set_quality(quality);
}

void Interface::Parts::bring_to_rest() {
  motion_left = 0;
  view.set_quality(DrawingQuality::still);
  compared.set_quality(DrawingQuality::still);
  scene_is_old = true;
}

void Interface::Parts::move_camera() {
  for (const CameraMotion& motion : state.camera_motions) {
    view.move(motion);
    camera_moved = !std::holds_alternative<camera_motion::Frame>(motion) &&
                   !std::holds_alternative<camera_motion::LookFrom>(motion);
    if (!camera_moved) framing = motion;
    if (!scripted && !state.picture)
      draw_fast(camera_moved ? DrawingQuality::moving : DrawingQuality::quick);
    else
      bring_to_rest();
  }
  state.camera_motions.clear();
}

/// Returns whether it was drawn anew. Who works by hand sees at once what came of it; what a script makes is for
/// pictures.
bool Interface::Parts::draw_scene() {
  bool changed = false;
  // A frame that waits for its own loops must not help the session with its long ones.
  tbb::this_task_arena::isolate([&] {
    changed = view.show(news.snapshot, state, news.inspection, news.progress.doubtful, news.surface);
    changed |= compared.show(news.snapshot, state, news.surface);
  });
  if (changed && script.done() && !state.presentation.demo && !state.picture && motion_left <= 0)
    draw_fast(DrawingQuality::quick);
  scene_is_old |= changed;
  if (!scene_is_old) return false;
  compared.share_depth(view);
  target.render();
  ++scene_drawings;
  scene_is_old = false;
  return true;
}

}  // namespace nextview
