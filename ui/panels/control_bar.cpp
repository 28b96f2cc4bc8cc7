#include "ui/panels/control_bar.hpp"

#include <fmt/format.h>

#include "ui/window/shortcuts.hpp"

namespace nextview {
namespace {

bool can_step(const PanelContext& context) { return context.snapshot.loaded() && context.snapshot.finished.empty(); }

std::string with_key(const char* text, Action action) { return fmt::format("{} [{}]", text, keys_of(action)); }

void draw_buttons(PanelContext& context) {
  const bool playing = context.progress.playing;
  ImGui::BeginDisabled(!can_step(context) || playing);
  if (icon_button(context.style, Icon::step, "Step", true)) request_step(context);
  ImGui::EndDisabled();
  tooltip(with_key("Take the next view", Action::step));
  ImGui::SameLine();
  ImGui::BeginDisabled(!can_step(context));
  if (icon_button(context.style, playing ? Icon::pause : Icon::play, playing ? "Pause" : "Play")) {
    request_play_or_pause(context);
  }
  ImGui::EndDisabled();
  tooltip(with_key(playing ? "Pause after this view" : "Take views until the scan is finished", Action::play));
  ImGui::SameLine();
  ImGui::BeginDisabled(!context.snapshot.loaded());
  if (icon_button(context.style, Icon::reset, "Reset")) request_reset(context);
  ImGui::EndDisabled();
  tooltip(with_key("Start over", Action::reset));
}

std::string readiness(const SessionSnapshot& s) {
  if (!s.loaded()) return "No object yet: choose one, or drop a file here";
  if (s.records.empty()) return "Ready to take the start view";
  return s.next_candidate ? fmt::format("Ready to take view {}", *s.next_candidate) : "No candidate is left";
}

/// Returns whether Cancel was pressed.
bool draw_progress(PanelContext& context, float left, float right, float y) {
  const WorkerProgress& progress = context.progress;
  const Style& style = context.style;
  ImGui::SetCursorPos({left, y});
  if (!progress.busy || (progress.what.empty() && !progress.playing)) {  // some commands take no time worth a word
    const SessionSnapshot& s = context.snapshot;
    ImGui::AlignTextToFramePadding();
    if (!s.finished.empty()) {
      ImGui::TextUnformatted(fmt::format("Finished: {}", s.finished).c_str());
    } else {
      ImGui::TextDisabled("%s", readiness(s).c_str());
    }
    return false;
  }
  const float button = style.px(100), bar = right - left - button;
  ImGui::PushFont(style.small);
  ImGui::SetCursorPos({left, y - style.px(6)});
  const std::string more = progress.waiting > 0 ? fmt::format(", {} more to do", progress.waiting) : "";
  ImGui::TextUnformatted((progress.what + more).c_str());
  ImGui::PopFont();
  ImGui::SetCursorPos({left, y + style.px(17)});
  ImGui::ProgressBar(float(progress.fraction), {bar, style.px(7)}, "");
  ImGui::SetCursorPos({left + bar + style.px(12), y - style.px(2)});
  const bool cancelled = icon_button(style, Icon::cancel, "Cancel");
  tooltip("Stop what is running. A view that has entered the map is completed.");
  return cancelled;
}

/// One number with its name beneath, from the right; returns where it starts.
float draw_figure(const PanelContext& context, float right, float y, const std::string& value, const char* name) {
  const Style& style = context.style;
  ImGui::PushFont(style.semi_bold);
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::PopFont();
  ImGui::PushFont(style.small);
  const float name_width = ImGui::CalcTextSize(name).x;
  ImGui::SetCursorPos({right - name_width, y + style.px(13)});
  ImGui::TextDisabled("%s", name);
  ImGui::PopFont();
  ImGui::PushFont(style.semi_bold);
  ImGui::SetCursorPos({right - value_width, y - style.px(6)});
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  return right - std::max(value_width, name_width) - style.px(26);
}

float draw_figures(const PanelContext& context, float right, float y) {
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return right;
  const bool any = !s.records.empty();
  if (s.configuration.evaluation.enabled) {
    const double coverage = any ? s.records.back().coverage_visible : 0.0;
    right = draw_figure(context, right, y, fmt::format("{:.1f} %", 100 * coverage), "of visible surface");
  }
  const double bits = any ? s.records.back().entropy : double(s.grid.voxel_count());
  right = draw_figure(context, right, y, fmt::format("{:.3f} Mbit", bits / 1e6), "entropy");
  const int views = s.configuration.termination.views;
  return draw_figure(context, right, y, fmt::format("{} / {}", s.records.size(), views), "views");
}

}  // namespace

void request_step(PanelContext& context) {
  if (can_step(context) && !context.progress.playing) context.commands.emplace_back(command::Step{});
}

void request_play_or_pause(PanelContext& context) {
  if (!can_step(context)) return;
  if (context.progress.playing) {
    context.commands.emplace_back(command::Pause{});
  } else {
    context.commands.emplace_back(command::Play{});
  }
}

void request_reset(PanelContext& context) {
  if (context.snapshot.loaded()) context.commands.emplace_back(command::Reset{});
}

bool draw_control_bar(PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Control bar", rectangle, ImGuiWindowFlags_NoScrollbar);
  const Style& style = context.style;
  const float y = (float(rectangle.height) - ImGui::GetFrameHeight() - style.px(4)) / 2;
  ImGui::SetCursorPos({style.px(14), y});
  draw_buttons(context);
  const float left = style.px(14 + 268 + 16);
  const float right = draw_figures(context, float(rectangle.width) - style.px(16), y + style.px(2));
  return draw_progress(context, left, right, y + style.px(2));
}

}  // namespace nextview
