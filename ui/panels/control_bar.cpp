#include "ui/panels/control_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/setting/entropy_text.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/scanner_commands.hpp"

namespace nextview {
namespace {

// [px] on a display that does not scale
constexpr float buttons_end = 316, speed_end = 396, min_bar = 40;

/// What was cancelled may take a moment to stop: that it was heard is seen at once.
void draw_cancel(const PanelContext& context) {
  if (!context.progress.cancelling) return command_button(context, command::cancel, Icon::cancel, "Cancel");
  ImGui::BeginDisabled();
  icon_button(context.style, Icon::none, "Cancelling …", false, context.style.px(88));
  ImGui::EndDisabled();
}

/// Where there is no room for progress, what runs is cancelled here.
void draw_buttons(const PanelContext& context, bool with_cancel) {
  const float gap = context.style.px(6);
  command_button(context, command::step, Icon::step, "Step", true);
  ImGui::SameLine(0, gap);
  const float width = context.style.px(84);  // of each word
  if (context.progress.playing) {
    command_button(context, command::pause, Icon::pause, "Pause", false, width);
  } else if (command::go_on.available(context.state())) {
    command_button(context, command::go_on, Icon::play, "Continue", false, width);
  } else {
    command_button(context, command::play, Icon::play, "Play", false, width);
  }
  ImGui::SameLine(0, gap);
  if (with_cancel) return draw_cancel(context);
  command_button(context, command::undo, Icon::undo, "");
  ImGui::SameLine(0, gap);
  command_button(context, command::redo, Icon::redo, "");
  ImGui::SameLine(0, gap);
  command_button(context, command::reset, Icon::reset, "");
}

/// How long Play waits between two views.
void draw_speed(const PanelContext& context, float x, float y) {
  const Style& style = context.style;
  float seconds = float(context.progress.pause_between_views);
  ImGui::SetCursorPos({x, y + style.px(1)});
  ImGui::SetNextItemWidth(style.px(72));
  ImGui::PushFont(style.small);
  if (ImGui::SliderFloat("##speed", &seconds, 0.0f, 5.0f, seconds > 0 ? "+%.1f s" : "no pause"))
    context.post(command::speed(std::round(10.0 * double(seconds)) / 10.0));
  ImGui::PopFont();
  tooltip(command::speed.help);
}

/// `brief`: cut off at its end it would not say which candidate.
std::string readiness(const SessionSnapshot& s, const WorkerProgress& progress, bool brief) {
  if (!s.finished.empty()) return "Finished: " + s.finished;
  if (progress.opening) return "Opening…";  // which takes long for a large mesh, or fine voxels
  if (s.scanner_lost) return "The scanner is lost";
  if (!s.loaded()) return "Nothing is open: choose an object, or drop a file here";
  if (s.records.empty()) return "Ready to take the start view";
  if (s.custom_next_view) return "Ready to take your custom view";
  if (!s.next_candidate) return "No candidate is left";
  return fmt::format("{} candidate {}", brief ? "Next:" : "Ready to take", *s.next_candidate);
}

std::string left_text(std::optional<double> seconds) {
  return seconds.value_or(0) >= 1 ? fmt::format(", about {:.0f} s left", *seconds) : "";
}

/// "scoring the candidate views, 2 more to do, about 12 s left"
std::string job_text(const WorkerProgress& progress) {
  std::string text = progress.paused ? "paused: " + progress.what : progress.what;
  if (text.empty()) text = "between two views";
  if (progress.waiting > 0) text += fmt::format(", {} more to do", progress.waiting);
  return text + left_text(progress.seconds_left);
}

/// What runs, and how far it is.
void draw_job(const Style& style, const std::string& text, double fraction, float left, float bar, float y) {
  ImGui::PushFont(style.small);
  ImGui::SetCursorPos({left, y - style.px(6)});
  const std::string shown = shortened(text, bar);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopFont();
  if (shown != text) tooltip(text);
  ImGui::SetCursorPos({left, y + style.px(17)});
  ImGui::ProgressBar(float(fraction), {bar, style.px(7)}, "");
}

void draw_readiness(const PanelContext& context, float left, float right, float y) {
  const SessionSnapshot& s = context.snapshot;
  const Style& style = context.style;
  ImGui::SetCursorPos({left, y});
  ImGui::AlignTextToFramePadding();
  const float button = s.scanner_lost ? style.px(132) : 0;
  const float room = right - left - button;
  const std::string text = readiness(s, context.progress, false);
  const bool is_too_long = ImGui::CalcTextSize(text.c_str()).x > room;
  const std::string shown = shortened(readiness(s, context.progress, is_too_long), room);
  s.finished.empty() ? ImGui::TextDisabled("%s", shown.c_str()) : ImGui::TextUnformatted(shown.c_str());
  if (shown != text) tooltip(text);
  if (!s.scanner_lost) return;
  ImGui::SetCursorPos({right - button + style.px(8), y - style.px(2)});
  command_button(context, command::reconnect, Icon::reset, "Reach it again", true);
}

/// Of the session, or else of the surface that is made beside it.
void draw_progress(const PanelContext& context, float left, float right, float y) {
  const WorkerProgress& progress = context.progress;
  const Style& style = context.style;
  const bool runs = progress.busy && (!progress.what.empty() || progress.playing);  // some take no time worth a word
  const float button = style.px(100), bar = right - left - button;
  const bool has_room = bar >= style.px(min_bar);
  if (!runs && (!context.surface_progress || !has_room)) return draw_readiness(context, left, right, y);
  if (!runs) {
    const SurfaceJob& surface = *context.surface_progress;
    return draw_job(style, "making the surface" + left_text(surface.seconds_left), surface.fraction, left, bar, y);
  }
  if (!has_room) return;  // the buttons have a Cancel then
  draw_job(style, job_text(progress), progress.fraction, left, bar, y);
  ImGui::SetCursorPos({left + bar + style.px(12), y - style.px(2)});
  draw_cancel(context);
}

/// One number with its name beneath, from the right, if there is room for it right of `least`; returns where it starts.
float draw_figure(const PanelContext& context, float least, float right, float y, const std::string& value,
                  const char* name, const char* meaning) {
  const Style& style = context.style;
  ImGui::PushFont(style.semi_bold);
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::PopFont();
  ImGui::PushFont(style.small);
  const float name_width = ImGui::CalcTextSize(name).x;
  if (right - std::max(value_width, name_width) < least) {
    ImGui::PopFont();
    return right;
  }
  ImGui::SetCursorPos({right - name_width, y + style.px(13)});
  ImGui::TextDisabled("%s", name);
  tooltip(meaning);
  ImGui::PopFont();
  ImGui::PushFont(style.semi_bold);
  ImGui::SetCursorPos({right - value_width, y - style.px(6)});
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  tooltip(meaning);
  return right - std::max(value_width, name_width) - style.px(26);
}

float draw_figures(const PanelContext& context, float least, float right, float y) {
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return right;
  const bool any = !s.records.empty();
  if (s.is_evaluated() || s.is_recording()) {
    const double coverage = any ? s.records.back().coverage_recorded.value_or(s.records.back().coverage_visible) : 0.0;
    right = draw_figure(context, least, right, y, fmt::format("{:.1f} %", 100 * coverage),
                        s.is_recording() ? "of all frames" : "of visible surface",
                        s.is_recording() ? "What was scanned, as a share of what all frames of the recording show."
                                         : "What was scanned, as a share of the true surface that some candidate view "
                                           "can see.");
  }
  const double bits = any ? s.records.back().entropy : s.setup->start_entropy.unmeasured;
  right = draw_figure(context, least, right, y, entropy_text(bits), "unmeasured entropy",
                      "Of the region: a bit for each voxel that nothing was measured in (Eq. 18).");
  const TerminationConfig& limits = s.configuration.termination;
  std::string taken = fmt::format("{}", s.records.size());
  if (limits.limits_views(s.records.size())) taken += fmt::format(" / {}", limits.views);
  return draw_figure(context, least, right, y, taken, "views",
                     "Views that were taken, and how many are taken at most.");
}

}  // namespace

void draw_control_bar(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Control bar", rectangle, ImGuiWindowFlags_NoScrollbar);
  const Style& style = context.style;
  const float y = (float(rectangle.height) - ImGui::GetFrameHeight() - style.px(4)) / 2;
  ImGui::SetCursorPos({style.px(14), y});
  const float end = float(rectangle.width) - style.px(16);
  const bool with_speed = end > style.px(speed_end + 330);
  const float left = style.px(with_speed ? speed_end : buttons_end);
  draw_buttons(context, context.progress.busy && end - left < style.px(100 + min_bar));
  if (with_speed) {
    ImGui::SameLine(0, style.px(10));
    draw_speed(context, ImGui::GetCursorPosX(), y);
  }
  const float right = draw_figures(context, left + style.px(150), end, y + style.px(2));
  draw_progress(context, left, right, y + style.px(2));
}

}  // namespace nextview
