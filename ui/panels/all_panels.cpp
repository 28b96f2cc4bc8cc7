#include "ui/panels/all_panels.hpp"

#include <imgui_internal.h>

#include <utility>

#include "ui/commands/command_list.hpp"
#include "ui/commands/scanner_commands.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/control_bar.hpp"
#include "ui/panels/guide.hpp"
#include "ui/panels/question.hpp"
#include "ui/panels/shortcut_sheet.hpp"
#include "ui/panels/status_line.hpp"
#include "ui/panels/tabs.hpp"

namespace nextview {
namespace {

/// Panels leave a pixel between them.
void draw_hairlines(const Layout& layout) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 colour = to_imgui_u32(theme::hairline);
  for (const Rectangle& r : {layout.menu, layout.left, layout.right, layout.scene, layout.bottom}) {
    if (r.empty()) continue;
    list.AddRect({float(r.x) - 1, float(r.y) - 1}, {float(r.x + r.width) + 1, float(r.y + r.height) + 1}, colour);
  }
}

}  // namespace

AllPanels::AllPanels(const std::vector<PanelEntry>& panels) {
  announce_panels(panels);
  for (const PanelEntry& panel : panels) contents_[panel.info.name] = panel.make();
}

void AllPanels::draw_side(const PanelContext& context, Side side, const Rectangle& rectangle, bool is_open) {
  if (rectangle.empty()) return;
  const Rectangle place = draw_tabs(context, side, rectangle, is_open);
  if (place.empty() || !is_open) return;
  if (const auto front = contents_.find(context.window.in_front(side)); front != contents_.end())
    front->second->draw(context, place);
}

void AllPanels::draw(const PanelContext& context, const Layout& layout, std::size_t log_count, double seconds) {
  if (!layout.menu.empty()) draw_menu_bar(context, layout.menu, recent_);
  if (!layout.control_bar.empty()) draw_control_bar(context, layout.control_bar);
  for (const Side side : {Side::left, Side::right, Side::bottom})
    draw_side(context, side, layout.of(side), layout.is_open(side));
  if (!layout.status.empty()) draw_status_line(context, layout.status);
  draw_hairlines(layout);
  const Rectangle beneath_menu{0, layout.menu.height, layout.menu.width, layout.height - layout.menu.height};
  const bool is_narrow = layout.scene.width < context.style.px(420);
  const Rectangle& front = is_narrow ? beneath_menu : layout.scene;
  // Where nothing is clicked, as far as there is such a place: tabs, Step and Play stay in reach, whatever is told.
  Rectangle told = layout.scene;
  if (told.width < context.style.px(120)) {
    const double top = layout.control_bar.y + layout.control_bar.height;
    told = {0, top, layout.menu.width, layout.height - top};
  }
  if (!context.window.presentation.demo) notifications_.draw(context, told, log_count, seconds);
  if (!layout.scene.empty()) draw_guide(context, layout.scene);
  draw_question(context, front);
  draw_shortcut_sheet(context, {0, 0, layout.menu.width, layout.height});
  manual_.draw(context, {0, 0, layout.menu.width, layout.height});
  palette_.draw(context, front);
  file_dialog_.draw(context, beneath_menu);
  popups_ = ImGui::GetCurrentContext()->OpenPopupStack.Size;
}

namespace {

/// Keys that move among the controls, and press the one that has the focus.
bool moves_focus(Key which) {
  return which == Key::space || which == Key::enter || (which >= Key::left && which <= Key::down);
}

/// What several commands share (play and pause) is done by the one that can be; if none can, the first says why.
void obey_shortcuts(const PanelContext& context) {
  const bool control = ImGui::GetIO().KeyCtrl, shift = ImGui::GetIO().KeyShift;
  const bool focus_is_shown = ImGui::GetIO().NavVisible;
  const Command* refused = nullptr;
  for (const Command& command : commands()) {
    for (const Shortcut& shortcut : command.shortcuts()) {
      const bool repeats = command.adds_up && !shortcut.values.empty();
      if (!shortcut.is_with(control, shift) || !pressed(shortcut.key, repeats)) continue;
      if (focus_is_shown && !control && moves_focus(shortcut.key)) continue;
      if (!command.available(context.state())) {
        if (!refused) refused = &command;
      } else if (shortcut.values.empty()) {
        return context.invoke(command);
      } else {
        return context.post(command.read(shortcut.values));
      }
    }
  }
  if (refused) context.invoke(*refused);
}

/// Of ImGui's keys Space alone presses what has the ring; people press Enter. False if nothing has one.
bool press_what_has_the_ring() {
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (!pressed(Key::enter) || !imgui.IO.NavVisible) return false;
  ImGui::ActivateItem(imgui.NavId);
  return true;
}

/// Escape gives the cautious answer at once, Enter another only to who can have read the question.
void obey_answers(const PanelContext& context, bool was_seen) {
  const std::vector<std::string>& answers = context.progress.answers;
  if (pressed(Key::escape)) return context.post(answer_to(context.progress, answers.back()));
  if (!was_seen) return;
  const bool is_in_it = ImGui::GetCurrentContext()->NavWindow == ImGui::FindWindowByName("Question");
  if (is_in_it && press_what_has_the_ring()) return;
  context.post(answer_to(context.progress, answers[context.progress.usual_answer()]));
}

/// Whether something lies over the panels that has the keyboard.
bool has_front(const PanelContext& context) {
  const WindowState& window = context.window;
  return !context.progress.question.empty() || !window.file_for.empty() || window.palette_open ||
         window.shortcuts_open || window.manual;
}

}  // namespace

/// Of itself ImGui goes to texts alone, and nowhere before a click. Tab begins at the first control of the panel that
/// was clicked, or brought to the front, last; arrows go on from there.
void AllPanels::begin_among_controls(const PanelContext& context) {
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const std::string& in_front = panel_info(context.window.in_front(context.window.open)).title;
  ImGuiWindow* const shown = ImGui::FindWindowByName(in_front.c_str());
  if (std::exchange(in_front_, in_front) != in_front && shown) ImGui::FocusWindow(shown);
  ImGuiWindow* const panel = imgui.NavWindow ? imgui.NavWindow : shown;
  if (!pressed(Key::tab) || imgui.IO.NavVisible || !panel || !panel->WasActive) return;
  ImGui::NavMoveRequestCancel();
  ImGui::FocusWindow(panel);
  ImGui::NavInitWindow(panel, true);
  imgui.NavDisableHighlight = false;
}

/// Who closes what lay in front goes on where they were: with the ring where it was, or with none, so that Space steps.
void AllPanels::come_back_from_front(const PanelContext& context) {
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const bool is_covered = has_front(context);
  if (is_covered && !was_covered_) {
    left_at_ = imgui.NavWindow ? imgui.NavWindow->ID : 0;
    left_with_ring_ = imgui.IO.NavVisible;
  } else if (!is_covered && was_covered_) {
    ImGuiWindow* const window = ImGui::FindWindowByID(left_at_);
    if (window && window->WasActive) ImGui::FocusWindow(window);
    imgui.NavDisableHighlight = !left_with_ring_;
    imgui.IO.NavVisible = left_with_ring_ && imgui.NavId != 0;
  }
  was_covered_ = is_covered;
}

/// Escape leaves what was clicked, and ImGui would show where one is then: Space would press that, and take no step.
void AllPanels::show_no_focus_after_clicks() {
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (pressed(Key::escape) && !focus_was_shown_) {
    imgui.NavDisableHighlight = true;
    imgui.IO.NavVisible = false;
  }
  focus_was_shown_ = imgui.IO.NavVisible;
}

/// Whether it is there for longer than a double press takes: what comes sooner was meant for the question before it.
bool AllPanels::question_was_seen(const PanelContext& context) {
  constexpr double moment = 0.3;  // [s]
  std::pair asked(context.progress.question_number, context.progress.question);
  if (asked != asked_) {
    asked_ = std::move(asked);
    asked_since_.reset();  // it is drawn in this frame, however long that takes
    return false;
  }
  if (!asked_since_) asked_since_ = ImGui::GetTime();
  return ImGui::GetTime() - *asked_since_ >= moment;
}

void AllPanels::obey_keys(const PanelContext& context) {
  const bool was_seen = question_was_seen(context);
  show_no_focus_after_clicks();
  come_back_from_front(context);
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_covered = context.window.palette_open || !context.window.file_for.empty();  // a question, by these
  if (popups_ > 0) {
    ImGuiContext& imgui = *ImGui::GetCurrentContext();
    press_what_has_the_ring();
    if (!pressed(Key::escape)) return;
    if (imgui.OpenPopupStack.Size == popups_) ImGui::ClosePopupToLevel(popups_ - 1, true);
    imgui.NavDisableMouseHover = true;  // until the pointer moves: a menu within a menu would open again beneath it
  } else if (!context.progress.question.empty() && !is_covered &&
             (pressed(Key::escape) || (pressed(Key::enter) && !io.WantTextInput))) {
    obey_answers(context, was_seen);
  } else if (!context.window.file_for.empty()) {
    if (pressed(Key::escape)) context.post(command::file_dialog());
  } else if (context.window.palette_open) {
    if (pressed(Key::escape) || (io.KeyCtrl && pressed(key('P')))) context.post(command::palette());
  } else if (context.window.shortcuts_open) {
    if (pressed(Key::escape) || pressed(Key::f1)) context.post(command::shortcuts());
  } else if (context.window.manual && (!io.WantTextInput || pressed(Key::escape))) {
    if (pressed(Key::escape)) context.post(command::manual());
    press_what_has_the_ring();
  } else if (!io.WantTextInput) {
    begin_among_controls(context);
    if (!press_what_has_the_ring()) obey_shortcuts(context);
  }
}

}  // namespace nextview
