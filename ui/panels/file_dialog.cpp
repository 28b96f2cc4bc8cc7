#include "ui/panels/file_dialog.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/file/read_file.hpp"
#include "core/journal/journal.hpp"
#include "core/session/untitled_sessions.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/export_commands.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What a command with several things to write takes without being told: what is shown.
std::vector<std::size_t> usual_choices(const Command& command, const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  if (&command == &command::export_map && context.snapshot.gibbs) return {std::size_t(layers.map)};
  if (&command != &command::export_surface) return {};
  const SurfaceSource source = layers.surface ? layers.surface_source : SurfaceSource::map;
  return {std::size_t(source), std::size_t(SurfacePart::seen)};
}

/// Where the origin of what a command writes is; of pictures and curves there is none.
std::string coordinates_of(const Command& command, const SessionSnapshot& s) {
  if (!(s.setup && s.loaded())) return "";
  const std::array<const Command*, 5> in_space{&command::export_scan, &command::export_cloud, &command::export_map,
                                               &command::export_surface, &command::export_views};
  if (std::ranges::find(in_space, &command) == in_space.end()) return "";
  const bool may_be_stl = &command == &command::export_surface || &command == &command::export_scan;
  const std::string unit = may_be_stl ? "In metres (STL: in mm), " : "In metres, ";
  if (s.live) return unit + "in the coordinates of the scanner.";
  if (s.is_recording()) return unit + "in the coordinates of the recording.";
  return unit + (s.configuration.object.centred
                     ? "z up, the object's middle in the origin (object.centred = false: that of its file)."
                     : "z up, the origin that of the object's file.");
}

std::string written_as(const Command& command, const SessionSnapshot& s) {
  std::string file = command.arguments().front().help;  // "a file that ends in .ply or .stl"
  file.front() = char(std::toupper(static_cast<unsigned char>(file.front())));
  const std::string coordinates = coordinates_of(command, s);
  return file + "." + (coordinates.empty() ? "" : " " + coordinates);
}

/// Of a text that may take several lines.
float height_of(const std::string& text) {
  if (text.empty()) return 0;
  const float width = ImGui::GetContentRegionAvail().x;
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + ImGui::GetStyle().ItemSpacing.y;
}

int open_popups() { return ImGui::GetCurrentContext()->OpenPopupStack.Size; }

}  // namespace

void FileDialog::write(std::string text) {
  written_ = std::move(text);
  replaced_.clear();
  problem_.clear();
}

/// Tab completes, and folders are looked into as they are written. The field has its own copy of what is written while
/// it has the keyboard.
void FileDialog::follow(ImGuiInputTextCallbackData& field) {
  if (field.EventFlag == ImGuiInputTextFlags_CallbackAlways) {
    if (std::exchange(opened_, false)) field.SelectAll();
    return;
  }
  const std::string written(field.Buf, std::size_t(field.BufTextLen));
  const bool tab = field.EventFlag == ImGuiInputTextFlags_CallbackCompletion;
  const std::string left = browser_.enter(tab ? browser_.completed(written) : written);
  entered_ = left.empty() && !written.empty();
  if (left == written) return;
  field.DeleteChars(0, field.BufTextLen);
  field.InsertChars(0, left.c_str());
}

void FileDialog::begin(const PanelContext& context, const Command& command) {
  command_ = command.name;
  to_read_ = !command.writes;
  plays_ = &command == &command::play_demo;
  recent_.read();
  chosen_ = 0;
  opened_ = true;
  written_as_ = to_read_ ? "" : written_as(command, context.snapshot);
  which_ = usual_choices(command, context);
  if (const auto failed = std::exchange(opening_, std::nullopt); failed && !failed->problem.empty()) {
    write(failed->written);
    problem_ = failed->problem;
    return;
  }
  write("");
  // Where something could not be written is not proposed again.
  if (is_there(wanted_) && context.snapshot.failures == failures_) last_written_ = wanted_.parent_path();
  const fs::path last = to_read_ ? last_read_ : last_written_;
  browser_.go_to(last.empty() ? fs::current_path() : last);
  const auto& suggested = command.arguments().front().choices;
  if (to_read_ || !suggested) return;
  const std::string name = suggested(context.snapshot).front();
  write(name);
  // No session is written over: the next name that is free.
  for (int number = 2; command.names_folder() && has_journal(browser_.meant(written_)); ++number)
    write(fmt::format("{}-{}", name, number));
}

void FileDialog::look_into(const fs::path& folder) {
  browser_.go_to(folder);
  chosen_ = 0;
  is_chosen_ = false;
}

void FileDialog::draw_path() {
  fs::path whole;
  fs::path wanted;
  for (const fs::path& part : browser_.folder()) {
    whole /= part;
    if (whole != whole.root_path()) ImGui::SameLine(0, 2);
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(part.c_str()).x + 24) ImGui::NewLine();
    if (ImGui::SmallButton(fmt::format("{}##{}", part.string(), whole.string()).c_str())) wanted = whole;
  }
  if (!wanted.empty()) look_into(wanted);
}

void FileDialog::draw_place(const std::string& name, const fs::path& folder) {
  if (ImGui::Selectable(name.c_str(), browser_.folder() == folder)) look_into(folder);
}

void FileDialog::draw_places(const PanelContext& context, const Command& command) {
  const Style& style = context.style;
  ImGui::PushFont(style.small);
  ImGui::TextDisabled("Places");
  if (const char* home = std::getenv("HOME")) draw_place("Home", home);
  draw_place("Started in", fs::current_path());
  std::error_code ignored;
  if (fs::is_directory(state_folder(), ignored)) draw_place("Kept sessions", state_folder());
  draw_place("Whole disk", "/");
  if (to_read_ && !plays_ && !recent_.entries.empty()) {  // before the objects, or it would have to be scrolled to
    ImGui::Spacing();
    ImGui::TextDisabled("Recent");
    for (const RecentMenu::Entry& entry : recent_.entries) {
      const std::string text = entry.name + (entry.summary.empty() ? "" : ", " + entry.summary),
                        file = entry.file.string();
      const std::string shown = shortened(text, ImGui::GetContentRegionAvail().x);
      if (ImGui::Selectable(fmt::format("{}##{}", shown, file).c_str())) accept(context, command, entry.file);
      tooltip(shown == text ? file : text + "\n" + file);
    }
  }
  if (to_read_) {
    ImGui::Spacing();
    ImGui::TextDisabled(plays_ ? "Demos" : "Objects");
    for (const std::string& object : command.arguments().front().choices(context.snapshot))
      if (ImGui::Selectable(object.c_str())) call(context, command, object);
  }
  ImGui::PopFont();
}

void FileDialog::draw_entries(const PanelContext& context, const Command& command) {
  if (!browser_.problem().empty()) small_text(context.style, browser_.problem(), theme::chosen);
  if (!ImGui::BeginTable("entries", 2)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.style.px(72));
  const std::vector<std::size_t> found = shown();
  chosen_ = std::min(chosen_, std::max<std::size_t>(found.size(), 1) - 1);
  fs::path accepted;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const FolderEntry& entry = browser_.entries()[found[i]];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name = entry.name + (entry.is_folder && !entry.is_session ? "/" : "");
    const std::string reason = why_not(entry);
    const bool of_no_use = !reason.empty();  // who takes it all the same is told why
    if (of_no_use) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const std::string fitting = shortened(name, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable(fmt::format("{}##{}", fitting, i).c_str(), i == chosen_,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
      chosen_ = i;
      is_chosen_ = true;
      if (!to_read_ && !entry.is_folder) write(entry.name);
      if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) accepted = browser_.folder() / entry.name;
    }
    if (of_no_use) ImGui::PopStyleColor();
    tooltip(of_no_use ? reason : fitting == name ? "" : name);
    if (i == chosen_ && scroll_) ImGui::SetScrollHereY();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", entry.is_session  ? "session"
                              : entry.is_folder ? "folder"
                                                : size_in_words(entry.bytes).c_str());
  }
  ImGui::EndTable();
  scroll_ = false;
  if (found.empty() && browser_.problem().empty())
    ImGui::TextDisabled("%s", !to_read_ || written_.empty() ? "An empty folder." : "No name here holds that.");
  if (!accepted.empty()) accept(context, command, accepted);
}

void FileDialog::obey_keys(const PanelContext& context, const Command& command) {
  const int by = int(pressed(Key::down, true)) - int(pressed(Key::up, true));
  if (by > 0 || (by < 0 && chosen_ > 0)) {  // that there are so many is seen to where they are drawn
    chosen_ += std::size_t(by);
    is_chosen_ = true;
    entered_ = false;
    scroll_ = true;
  }
  if (pressed(Key::enter)) accept_written(context, command);
}

void FileDialog::draw_which(const Command& command, const SessionSnapshot& snapshot) {
  for (std::size_t k = 0; k < which_.size(); ++k) {
    const Argument& argument = command.arguments()[k + 1];
    if (k > 0) ImGui::SameLine(0, 2 * ImGui::GetFontSize());
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", argument.name.c_str());
    tooltip(argument.help);
    const std::vector<std::string> values = argument.choices(snapshot);
    for (std::size_t value = 0; value < values.size(); ++value) {
      ImGui::SameLine();
      if (ImGui::RadioButton(values[value].c_str(), which_[k] == value)) which_[k] = value;
      tooltip(argument.help);
    }
  }
}

void FileDialog::draw_field(const PanelContext& context, const Command& command) {
  const Style& style = context.style;
  draw_which(command, context.snapshot);
  if (!written_as_.empty()) small_text(style, written_as_);
  if (!replaced_.empty())
    small_text(style, fmt::format("{} is there already.", fs::path(replaced_).filename().string()), theme::chosen);
  if (!problem_.empty()) small_text(style, problem_, theme::chosen);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::IsAnyItemActive() && open_popups() == 0) ImGui::SetKeyboardFocusHere();  // letters always go there
  const std::string hint =
      to_read_ ? "A part of a name, or a path; Tab completes it" : command.arguments().front().help;
  const auto follow = [](ImGuiInputTextCallbackData* field) {
    static_cast<FileDialog*>(field->UserData)->follow(*field);
    return 0;
  };
  if (ImGui::InputTextWithHint("##file", hint.c_str(), &written_,
                               ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackEdit |
                                   ImGuiInputTextFlags_CallbackAlways,
                               follow, this)) {
    chosen_ = 0;
    is_chosen_ = false;
    replaced_.clear();
    problem_.clear();
  }
  const char* const does = !replaced_.empty() ? "Replace it" : plays_ ? "Play" : to_read_ ? "Open" : "Write";
  if (icon_button(style, Icon::none, does, true)) accept_written(context, command);
  if (to_read_ && !plays_) {
    ImGui::SameLine();
    const std::string folder = wanted_folder().string();
    if (icon_button(style, Icon::none, "Open this folder")) call(context, command, folder);
    tooltip(folder + ": goes through the recorded scans that lie in it, or goes on with the session that it is.");
  }
  ImGui::SameLine();
  if (icon_button(style, Icon::none, "Cancel")) context.post(command::file_dialog());
}

void FileDialog::draw(const PanelContext& context, const Rectangle& place) {
  const std::string& wanted = context.window.file_for;
  if (wanted.empty()) {
    command_.clear();
    return follow_opening(context);
  }
  const Command& command = find_command(wanted);
  if (command_ != wanted) begin(context, command);
  const Style& style = context.style;
  const float margin = style.px(8);
  const ImVec2 size(std::min(style.px(680), float(place.width) - 2 * margin),
                    std::min(style.px(460), float(place.height) - 2 * margin));
  ImGui::SetNextWindowPos({float(place.x + place.width / 2), float(place.y + place.height / 2)}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::Begin("File", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav);
  std::string title = plays_ ? "Play a demo" : command.text;
  if (title.ends_with("…")) title.resize(title.size() - std::string("…").size());
  heading(style, title.c_str());
  draw_path();
  const float rest = 2 * ImGui::GetFrameHeightWithSpacing() + style.px(6) + height_of(problem_) +
                     (replaced_.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing()) + height_of(written_as_) +
                     (which_.empty() ? 0 : ImGui::GetFrameHeightWithSpacing());
  const float height = std::max(ImGui::GetContentRegionAvail().y - rest, style.px(40));
  ImGui::BeginChild("places", {std::min(style.px(150), 0.3f * size.x), height});
  draw_places(context, command);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("entries", {0, height}, true);
  draw_entries(context, command);
  ImGui::EndChild();
  draw_field(context, command);
  obey_keys(context, command);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nextview
