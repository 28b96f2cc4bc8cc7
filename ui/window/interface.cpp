#include "ui/window/interface.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>

#include <algorithm>

#include "ui/panels/candidates_panel.hpp"
#include "ui/panels/control_bar.hpp"
#include "ui/panels/curves_panel.hpp"
#include "ui/panels/layers_panel.hpp"
#include "ui/panels/session_panel.hpp"
#include "ui/panels/shortcut_sheet.hpp"
#include "ui/panels/status_line.hpp"
#include "ui/window/camera_control.hpp"
#include "ui/window/candidate_overlay.hpp"
#include "ui/window/shortcuts.hpp"

namespace nextview {
namespace {

/// ImGui's windows settle within a few frames.
constexpr int frames_to_settle = 3;
/// A press that moved less than this before its release is a click [px].
constexpr double click_reach = 4.0;

constexpr unsigned int gl_draw_framebuffer = 0x8CA9, gl_back = 0x0405;

enum class Drag { none, orbit, pan };

}  // namespace

struct Interface::Parts {
  Parts(RenderSurface& s, SessionWorker& w) : surface(s), worker(w), view(s), layout(1, 1, 1) {}

  RenderSurface& surface;
  SessionWorker& worker;
  ImGuiContext* imgui = nullptr;
  Style style;
  Clipboard clipboard;
  std::string pasted;
  InputQueue queue;

  SceneView view;
  SessionPanel session_panel;
  CandidatesPanel candidates_panel;
  Layout layout;
  int width = 0, height = 0;  ///< that the layout was made for [px]
  LayerChoice layers;
  CandidateFocus focus;
  std::uint64_t focus_session = 0;
  bool show_shortcuts = false, quit = false;

  std::shared_ptr<const SessionSnapshot> snapshot;
  WorkerProgress progress;
  Drag drag = Drag::none;
  bool camera_moved = false;  ///< by a person, since it was framed
  bool scene_is_old = true;
  std::size_t scene_drawings = 0;
  int settling = frames_to_settle;

  void take_input();
  void follow_size();
  void obey_keys(PanelContext& context);
  void obey_action(PanelContext& context, Action action);
  void move_camera(PanelContext& context);
  void draw_panels(PanelContext& context);
  void draw_hairlines() const;
  void draw_scene();
  void frame();
};

Interface::Interface(RenderSurface& surface, SessionWorker& worker, double scale)
    : parts_(std::make_unique<Parts>(surface, worker)) {
  surface.make_current();
  parts_->imgui = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;  // a blinking cursor would be the only reason to draw while nothing happens
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  const std::pair<ImGuiKey, Key> keys[] = {
      {ImGuiKey_Tab, Key::tab},       {ImGuiKey_LeftArrow, Key::left}, {ImGuiKey_RightArrow, Key::right},
      {ImGuiKey_UpArrow, Key::up},    {ImGuiKey_DownArrow, Key::down}, {ImGuiKey_Home, Key::home},
      {ImGuiKey_End, Key::end},       {ImGuiKey_PageUp, Key::page_up}, {ImGuiKey_PageDown, Key::page_down},
      {ImGuiKey_Delete, Key::del},    {ImGuiKey_Enter, Key::enter},    {ImGuiKey_Backspace, Key::backspace},
      {ImGuiKey_Escape, Key::escape}, {ImGuiKey_Space, Key::space},    {ImGuiKey_A, key('A')},
      {ImGuiKey_C, key('C')},         {ImGuiKey_V, key('V')},          {ImGuiKey_X, key('X')},
      {ImGuiKey_Y, key('Y')},         {ImGuiKey_Z, key('Z')}};
  for (const auto& [imgui_key, own] : keys) io.KeyMap[imgui_key] = static_cast<int>(own);
  parts_->style = apply_style(float(scale));
  ImGui_ImplOpenGL3_Init("#version 150");
  parts_->snapshot = worker.snapshot();
}

Interface::~Interface() {
  parts_->surface.make_current();
  ImGui::SetCurrentContext(parts_->imgui);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(parts_->imgui);
}

void Interface::set_clipboard(Clipboard clipboard) {
  parts_->clipboard = std::move(clipboard);
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = parts_.get();
  io.GetClipboardTextFn = [](void* user) {
    Parts& parts = *static_cast<Parts*>(user);
    parts.pasted = parts.clipboard.get();
    return parts.pasted.c_str();
  };
  io.SetClipboardTextFn = [](void* user, const char* text) { static_cast<Parts*>(user)->clipboard.set(text); };
}

void Interface::push(const InputEvent& event) { parts_->queue.push(event); }

double Interface::seconds_to_next_frame() const {
  const Parts& p = *parts_;
  const bool resized = p.width != p.surface.width() || p.height != p.surface.height();
  const bool news = p.snapshot != p.worker.snapshot() || p.progress != p.worker.progress();
  if (p.settling > 0 || !p.queue.empty() || resized || news) return 0.0;
  return seconds_to_tooltip(*p.imgui);
}

bool Interface::wants_to_quit() const { return parts_->quit; }
const Layout& Interface::layout() const { return parts_->layout; }
std::size_t Interface::scene_drawings() const { return parts_->scene_drawings; }

std::string Interface::title() const {
  const SessionSnapshot& s = *parts_->snapshot;
  if (!s.loaded()) return "Nextview";
  return fmt::format("Nextview - {} - view {} of {}", s.object_name, s.records.size(),
                     s.configuration.termination.views);
}

void Interface::Parts::take_input() {
  ImGuiIO& io = ImGui::GetIO();
  io.MouseWheel = 0;
  for (const InputEvent& event : queue.take_frame()) {
    settling = frames_to_settle;
    if (const auto* move = std::get_if<input::Move>(&event)) {
      io.MousePos = {float(move->x), float(move->y)};
    } else if (const auto* button = std::get_if<input::Button>(&event)) {
      io.MouseDown[static_cast<int>(button->button)] = button->down;
    } else if (const auto* wheel = std::get_if<input::Wheel>(&event)) {
      io.MouseWheel = float(wheel->steps);
    } else if (const auto* change = std::get_if<input::KeyChange>(&event)) {
      io.KeysDown[static_cast<int>(change->key)] = change->down;
    } else if (const auto* text = std::get_if<input::Text>(&event)) {
      io.AddInputCharacter(text->character);
    } else if (const auto* drop = std::get_if<input::Drop>(&event)) {
      worker.post(command::OpenFile{drop->file});
    }
  }
  io.KeyCtrl = io.KeysDown[static_cast<int>(Key::control)];
  io.KeyShift = io.KeysDown[static_cast<int>(Key::shift)];
  io.KeyAlt = io.KeysDown[static_cast<int>(Key::alt)];
}

void Interface::Parts::follow_size() {
  if (width == surface.width() && height == surface.height()) return;
  width = surface.width();
  height = surface.height();
  layout = Layout(width, height, style.scale);
  view.place(layout.scene);
  if (!camera_moved) view.frame();
  scene_is_old = true;
  settling = frames_to_settle;
}

void Interface::Parts::frame() {
  view.frame();
  camera_moved = false;
  scene_is_old = true;
}

void Interface::Parts::obey_action(PanelContext& context, Action action) {
  if (action == Action::step) request_step(context);
  if (action == Action::play) request_play_or_pause(context);
  if (action == Action::reset) request_reset(context);
  if (action == Action::frame) frame();
  if (action == Action::show_shortcuts) show_shortcuts = !show_shortcuts;
  if (action == Action::quit) quit = true;
  if (bool* shown = layer_of(layers, action)) *shown = !*shown;
}

void Interface::Parts::obey_keys(PanelContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  if (show_shortcuts && ImGui::IsKeyPressed(static_cast<int>(Key::escape), false)) show_shortcuts = false;
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.control == io.KeyCtrl && ImGui::IsKeyPressed(static_cast<int>(shortcut.key), false)) {
      obey_action(context, shortcut.action);
    }
  }
}

void Interface::Parts::move_camera(PanelContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_scene = !io.WantCaptureMouse && layout.scene.contains(io.MousePos.x, io.MousePos.y);
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left),
             middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
  if (over_scene && drag == Drag::none && (left || middle)) drag = left && !io.KeyShift ? Drag::orbit : Drag::pan;
  if (over_scene && drag == Drag::none && layers.views) {
    if (const auto candidate = candidate_at(view, *snapshot, io.MousePos.x, io.MousePos.y)) focus.hovered = candidate;
  }
  if (drag != Drag::none) {
    const ImVec2 by = io.MouseDelta;
    if (by.x != 0 || by.y != 0) {
      drag == Drag::orbit ? orbit(view.renderer(), by.x, by.y) : pan(view.renderer(), by.x, by.y);
      camera_moved = scene_is_old = true;
    }
    const bool held = io.MouseDown[ImGuiMouseButton_Left] || io.MouseDown[ImGuiMouseButton_Middle];
    if (!held) {
      const bool click = ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                         io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < click_reach * click_reach;
      if (click && layers.views) focus.selected = candidate_at(view, context.snapshot, io.MousePos.x, io.MousePos.y);
      drag = Drag::none;
    }
  }
  if (over_scene && io.MouseWheel != 0) {
    zoom(view.renderer(), io.MouseWheel);
    camera_moved = scene_is_old = true;
  }
}

void Interface::Parts::draw_panels(PanelContext& context) {
  if (draw_control_bar(context, layout.control_bar)) worker.cancel();
  session_panel.draw(context, layout.session);
  draw_layers_panel(context, layout.layers, layers);
  candidates_panel.draw(context, layout.candidates, focus);
  draw_curves_panel(context, layout.curves);
  draw_status_line(context, layout.status);
  draw_candidate_overlay(view, context, focus);
  draw_hairlines();
  draw_shortcut_sheet(style, layout.scene, show_shortcuts);
}

/// Panels leave a pixel between them.
void Interface::Parts::draw_hairlines() const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 colour = to_imgui_u32(theme::hairline);
  for (const Rectangle& r : {layout.session, layout.layers, layout.candidates, layout.scene, layout.curves}) {
    list.AddRect({float(r.x) - 1, float(r.y) - 1}, {float(r.x + r.width) + 1, float(r.y + r.height) + 1}, colour);
  }
}

void Interface::Parts::draw_scene() {
  const bool new_session = snapshot->loaded() && focus_session != snapshot->session;
  if (new_session) {
    focus = {};
    focus_session = snapshot->session;
    camera_moved = false;
  }
  scene_is_old |= view.show(snapshot, layers);
  vtkGenericOpenGLRenderWindow& window = surface.window();
  if (scene_is_old) {
    surface.render();
    ++scene_drawings;
  }
  surface.make_current();
  vtkOpenGLState& state = *window.GetState();
  state.vtkglBindFramebuffer(gl_draw_framebuffer, 0);
  state.vtkglDrawBuffer(gl_back);
  if (!scene_is_old) window.BlitDisplayFramebuffer();
  scene_is_old = false;
}

void Interface::draw(double seconds) {
  Parts& p = *parts_;
  ImGui::SetCurrentContext(p.imgui);
  p.surface.make_current();
  p.settling = std::max(p.settling - 1, 0);
  const auto snapshot = p.worker.snapshot();
  const WorkerProgress progress = p.worker.progress();
  if (snapshot != p.snapshot || progress.busy != p.progress.busy) p.settling = frames_to_settle;
  p.snapshot = snapshot;
  p.progress = progress;
  p.take_input();
  p.follow_size();

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(p.width), float(p.height)};
  io.DeltaTime = std::max(float(seconds), 1e-4f);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  std::vector<SessionCommand> commands;
  PanelContext context{*p.snapshot, p.progress, p.style, commands};
  p.focus.hovered.reset();
  p.obey_keys(context);
  p.move_camera(context);
  p.draw_panels(context);
  ImGui::Render();
  p.draw_scene();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  for (SessionCommand& command : commands) p.worker.post(std::move(command));
}

}  // namespace nextview
