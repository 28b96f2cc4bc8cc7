#include "ui/panels/notifications.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include "ui/commands/command_list.hpp"
#include "ui/panels/log_panel.hpp"

namespace nextview {
namespace {

constexpr double shown_seconds = 6.0, warning_seconds = 12.0;
constexpr std::size_t max_notes = 3;

/// Who reads it pressed a key or a button: the command's name, which scripts and the log need, says nothing to them.
std::string without_command_name(const std::string& text) {
  const std::size_t end = text.find(": ");
  if (end == text.npos || !std::ranges::count(commands(), text.substr(0, end), &Command::name)) return text;
  std::string rest = text.substr(end + 2);
  if (!rest.empty()) rest[0] = char(std::toupper(static_cast<unsigned char>(rest[0])));
  return rest;
}

}  // namespace

double Notifications::seconds_left() const {
  if (shrinks_) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Note& note : notes_) least = std::min(least, note.seconds_left);
  return least;
}

/// Of the object before nothing is news once another is opened, nor that a thing failed once it went well.
void Notifications::drop_outdated(const PanelContext& context) {
  if (context.progress.opening && !opening_) notes_.clear();
  opening_ = context.progress.opening;
  const std::string failed = std::exchange(message_, context.snapshot.message);
  std::erase_if(notes_, [&](const Note& note) {
    return note.seconds_left <= 0 || (failed != message_ && note.entry.text == failed);
  });
}

void Notifications::draw(const PanelContext& context, const Rectangle& scene, std::size_t count, double seconds) {
  for (Note& note : notes_) note.seconds_left -= seconds;
  const std::size_t before = notes_.size();
  drop_outdated(context);
  shrinks_ = notes_.size() < before;
  const auto& log = context.log;
  for (std::size_t back = std::min(count - std::min(seen_, count), log.size()); back > 0; --back) {
    LogEntry entry = log[log.size() - back];
    if (entry.level == LogEntry::Level::note) continue;
    entry.text = without_command_name(entry.text);
    // It is said again, maybe with more.
    std::erase_if(notes_, [&](const Note& note) { return entry.text.starts_with(note.entry.text); });
    notes_.push_back({entry, entry.level == LogEntry::Level::warning ? warning_seconds : shown_seconds});
  }
  seen_ = count;
  if (notes_.size() > max_notes) notes_.erase(notes_.begin(), notes_.end() - max_notes);
  if (notes_.empty()) return;
  const Style& style = context.style;
  ImGui::SetNextWindowPos({float(scene.x) + style.px(12), float(scene.y) + style.px(12)});
  const float widest = float(scene.width) - style.px(24);
  ImGui::SetNextWindowSize({std::clamp(float(scene.width) * 0.6f, std::min(style.px(240), widest), style.px(400)), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::Begin("Notifications", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoMouseInputs);  // the scene's, beneath it
  ImGui::PushFont(style.small);
  for (const Note& note : notes_) draw_entry(style, note.entry);
  ImGui::PopFont();
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const bool is_met = ImGui::IsMouseHoveringRect(from, {from.x + size.x, from.y + size.y}, false);
  if (is_met && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) notes_.clear();
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nextview
