// Pictures that the window writes: of itself, of its scene from one side or from all around, of the curves.
#include <fmt/format.h>
#include <imgui.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include "core/config/configuration.hpp"
#include "core/export/frame_folder.hpp"
#include "core/file/atomic_file.hpp"
#include "ui/charts/chart_page.hpp"
#include "ui/commands/export_commands.hpp"
#include "ui/panels/curves_panel.hpp"
#include "ui/window/interface_parts.hpp"
#include "ui/window/panels_alone.hpp"

namespace nextview {
namespace {

using Of = PictureRequest::Of;

/// The command that asked for it; for messages.
const Command& command_of(const PictureRequest& request) {
  switch (request.of) {
    case Of::scene:
      return command::export_picture;
    case Of::turntable:
      return command::export_turntable;
    case Of::curves:
      return command::export_curves;
    case Of::window:
      break;
  }
  return command::save_picture;
}

}  // namespace

WorkerProgress Interface::Parts::progress() const {
  WorkerProgress shown = news.progress;
  if (shown.busy || !state.picture || state.picture->of != Of::turntable) return shown;
  shown.busy = true;
  shown.fraction = double(state.picture->drawn) / state.picture->frames;
  shown.what = fmt::format("drawing frame {} of {}", state.picture->drawn + 1, state.picture->frames);
  return shown;
}

/// What is drawn beside the window's own frame, and before it, as the scene has to be drawn anew after it.
void Interface::Parts::draw_wanted_picture() {
  if (!state.picture) return;
  if (motion_left > 0) bring_to_rest();
  if (state.picture->of == Of::window) return;  // it is drawn with the frame
  try {
    draw_apart();
  } catch (const std::exception& error) {
    picture_failed(error.what());
  }
  scene_is_old = true;
  composer.forget();
  if (state.picture) draw_fast(DrawingQuality::coarse);  // of a turntable others follow, and this one is soon gone
}

void Interface::Parts::draw_apart() {
  const PictureRequest request = *state.picture;
  if (request.of == Of::turntable) return draw_next_frame();
  if (request.of == Of::curves)
    draw_curves();
  else
    write_wanted(compared.draw_apart(view, request.size, request.transparent), request.file);
  state.picture.reset();
  worker.log().add(LogEntry::Level::success, "Picture written to " + request.file);
}

/// One with each frame of the window, which goes on meanwhile.
void Interface::Parts::draw_next_frame() {
  PictureRequest& request = *state.picture;
  if (request.drawn == 0) make_frame_folder(request.file);
  const double degrees = 360.0 * request.drawn / request.frames;
  write_wanted(compared.draw_apart(view, request.size, request.transparent, degrees),
               std::filesystem::path(request.file) / frame_name(request.drawn + 1));
  if (++request.drawn < request.frames) return;
  worker.log().add(LogEntry::Level::success, fmt::format("{} frames written to {}", request.frames, request.file));
  state.picture.reset();
}

void Interface::Parts::draw_curves() const {
  const PictureRequest& request = *state.picture;
  const std::vector<ChartContent> charts = scan_charts(scan_course(*news.snapshot));
  const PictureSize size = request.size.value_or(page_size(charts.size()));
  if (request.file.ends_with(".svg")) return write_file(request.file, charts_svg(charts, size, request.transparent));
  write_wanted(draw_charts(target, charts, size, request.transparent), request.file);
}

/// With the configuration that it shows.
void Interface::Parts::write_wanted(const Image& image, const std::filesystem::path& file) const {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  write_png(image, file, to_toml(news.snapshot->configuration, folder));
}

void Interface::Parts::picture_failed(const std::string& reason) {
  const PictureRequest request = *std::exchange(state.picture, std::nullopt);
  const Command& command = command_of(request);
  const std::string line = fmt::format("{}: {}", command.name, reason);
  script.refused(command.read({request.file}), line);
  worker.log().add(LogEntry::Level::warning, line);
}

/// Without what is in front of the panels; the back buffer then has the whole frame again.
Image Interface::Parts::draw_window() {
  PanelsAlone alone(*ImGui::GetDrawData());
  composer.compose(alone.data(), std::nullopt, false);
  Image picture = composer.read();
  composer.compose(*ImGui::GetDrawData(), std::nullopt, false);
  composer.fill_back_buffer();
  return picture;
}

/// A picture of another size is drawn as in a window of that size; those frames are shown to nobody.
void Interface::Parts::take_picture_size() {
  if (!state.picture || state.picture->of != Of::window || !state.picture->size) return;
  const PictureSize before{target.width(), target.height()}, &size = *state.picture->size;
  if (size == before) return;
  size_before = before;  // each frame anew: the target of a window follows that
  target.window().SetSize(size.width, size.height);
}

void Interface::Parts::leave_picture_size() {
  if (!size_before) return;
  target.window().SetSize(size_before->width, size_before->height);
  size_before.reset();
  scene_is_old = true;
  composer.forget();
}

void Interface::Parts::write_window_picture() {
  if (!state.picture || state.picture->of != Of::window) return;
  if (size_before && state.picture->drawn++ < frames_to_settle) return;
  const Image picture = draw_window();
  leave_picture_size();
  const std::string file = state.picture->file;
  try {
    write_wanted(picture, file);
    state.picture.reset();
    worker.log().add(LogEntry::Level::success, "Picture written to " + file);
  } catch (const std::exception& error) {
    picture_failed(error.what());
  }
}

}  // namespace nextview
