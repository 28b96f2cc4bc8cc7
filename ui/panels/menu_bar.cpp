#include "ui/panels/menu_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/session/recent_files.hpp"
#include "core/session/untitled_sessions.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/scene_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// What was opened last, with what there is to tell of the sessions among them.
void draw_recent(const PanelContext& context, RecentMenu& recent) {
  if (!ImGui::BeginMenu("Open recent")) return;
  if (ImGui::IsWindowAppearing()) recent.read();
  for (const RecentMenu::Entry& entry : recent.entries) {
    const bool can = command::open.available(context.state());
    if (ImGui::MenuItem(fmt::format("{}##{}", entry.name, entry.file.string()).c_str(), entry.summary.c_str(), false,
                        can))
      context.post(command::open(entry.file.string()));
    tooltip(entry.file.string());
  }
  if (recent.entries.empty()) ImGui::TextDisabled("Nothing was opened yet.");
  ImGui::EndMenu();
}

/// The cameras that were kept.
void draw_cameras(const PanelContext& context) {
  const auto& cameras = context.snapshot.cameras;
  if (!cameras || cameras->empty() || !ImGui::BeginMenu("Kept cameras")) return;
  for (const CameraBookmark& camera : *cameras)
    if (ImGui::MenuItem(camera.name.c_str())) context.post(command::go_to_camera(camera.name));
  ImGui::EndMenu();
}

/// Those that come with the program, and others' files.
void draw_demos(const PanelContext& context) {
  if (!ImGui::BeginMenu("Play another")) return;
  const bool can = command::play_demo.available(context.state());
  for (const std::string& demo : demo_names())
    if (ImGui::MenuItem(demo.c_str(), nullptr, false, can)) context.post(command::play_demo(demo));
  ImGui::Separator();
  if (ImGui::MenuItem("A file…", nullptr, false, can)) context.post(command::file_dialog(command::play_demo.name));
  ImGui::EndMenu();
}

/// Commands that begin a group of their menu.
constexpr std::array group_begins = {"set",
                                     "connect",
                                     "export",
                                     "save-picture",
                                     "quit",
                                     "pause",
                                     "take-view",
                                     "answer",
                                     "undo",
                                     "branch",
                                     "compare",
                                     "inspect-voxel",
                                     "clear-selection",
                                     "toggle-orthographic",
                                     "keep-camera",
                                     "section-axis",
                                     "object-style",
                                     "toggle-occupied",
                                     "slice",
                                     "lock-ranges",
                                     "dark",
                                     "palette",
                                     "caption",
                                     "orbit",
                                     "wait"};

void draw_menu(const PanelContext& context, const std::string& menu, RecentMenu& recent) {
  bool any = false;
  for (const Command& command : commands()) {
    if (command.menu != menu || &command == &command::file_dialog) continue;  // which the File menu's commands open
    if (any && std::ranges::find(group_begins, command.name) != group_begins.end()) ImGui::Separator();
    any = true;
    const bool on = command.on && command.on(context.window);
    if (ImGui::MenuItem(command.text.c_str(), command.keys().c_str(), on, command.available(context.state())))
      context.invoke(command);
    tooltip(help_of(context, command));
    if (&command == &command::open) draw_recent(context, recent);
    if (&command == &command::remove_camera) draw_cameras(context);
    if (&command == &command::play_demo) draw_demos(context);
  }
}

constexpr const char* more = "More";  // the menu of those that have no room beside the others

/// How many menus have room beside each other, with one more for the rest if not all do.
std::ptrdiff_t fitting(const std::vector<std::string>& menus, float width) {
  const auto needed = [](const std::string& menu) {
    return ImGui::CalcTextSize(menu.c_str()).x + 2 * ImGui::GetStyle().ItemSpacing.x;
  };
  float all = 0;
  for (const std::string& menu : menus) all += needed(menu);
  if (all <= width) return std::ssize(menus);
  float taken = needed(more);
  std::ptrdiff_t count = 0;
  while (count < std::ssize(menus) && (taken += needed(menus[std::size_t(count)])) <= width) ++count;
  return count;
}

}  // namespace

void RecentMenu::read() {
  entries.clear();
  for (const std::filesystem::path& file : recent_files(state_folder())) {
    const std::optional<EarlierSession> session = earlier_session(state_folder(), file);
    entries.push_back({file, session ? session->name : file.filename().string(), session ? session->summary() : ""});
  }
}

void draw_menu_bar(const PanelContext& context, const Rectangle& rectangle, RecentMenu& recent) {
  const Style& style = context.style;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(style.px(8), style.px(5)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(6), 0));
  const Panel panel("Menu", rectangle, ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar(2);
  if (!ImGui::BeginMenuBar()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(10), style.px(8)));
  const float below = float(rectangle.y + rectangle.height);
  // What is too long scrolls: it would open above, with its first item beneath the pointer.
  const auto begin_menu = [&](const std::string& name) {
    ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, ImGui::GetIO().DisplaySize.y - below - style.px(2)});
    return ImGui::BeginMenu(name.c_str());
  };
  const auto draw = [&](const std::string& menu) {
    if (!begin_menu(menu)) return;
    draw_menu(context, menu, recent);
    ImGui::EndMenu();
  };
  const std::vector<std::string> all = menus();
  const auto beside = all.begin() + fitting(all, float(rectangle.width) - style.px(12));
  std::for_each(all.begin(), beside, draw);
  if (beside != all.end() && begin_menu(more)) {
    std::for_each(beside, all.end(), draw);
    ImGui::EndMenu();
  }
  ImGui::PopStyleVar();
  ImGui::EndMenuBar();
}

}  // namespace nextview
