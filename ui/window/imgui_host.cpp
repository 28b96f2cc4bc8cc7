#include "ui/window/imgui_host.hpp"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "ui/workbench/overloaded.hpp"

namespace nextview {
namespace {

/// Page Up and Page Down are commands: ImGui would also focus a panel's first or last item, which the next Space
/// presses.
constexpr std::pair<ImGuiKey, Key> keys[] = {
    {ImGuiKey_Tab, Key::tab},       {ImGuiKey_LeftArrow, Key::left}, {ImGuiKey_RightArrow, Key::right},
    {ImGuiKey_UpArrow, Key::up},    {ImGuiKey_DownArrow, Key::down}, {ImGuiKey_Home, Key::home},
    {ImGuiKey_End, Key::end},       {ImGuiKey_Delete, Key::del},     {ImGuiKey_Enter, Key::enter},
    {ImGuiKey_Escape, Key::escape}, {ImGuiKey_Space, Key::space},    {ImGuiKey_Backspace, Key::backspace},
    {ImGuiKey_A, key('A')},         {ImGuiKey_C, key('C')},          {ImGuiKey_V, key('V')},
    {ImGuiKey_X, key('X')},         {ImGuiKey_Y, key('Y')},          {ImGuiKey_Z, key('Z')}};

}  // namespace

ImguiHost::ImguiHost(double scale) : context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;  // a blinking cursor would be the only reason to draw while nothing happens
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  for (const auto& [imgui_key, own] : keys) io.KeyMap[imgui_key] = static_cast<int>(own);
  style_ = apply_style(float(scale));
}

void ImguiHost::set_scale(double scale) {
  const bool dark = is_dark();
  ImGui::GetIO().Fonts->Clear();
  style_ = apply_style(float(scale));
  set_colours(dark);
}

void ImguiHost::set_dark(bool dark) {
  if (dark != is_dark()) set_colours(dark);
}

ImguiHost::~ImguiHost() { ImGui::DestroyContext(context_); }

void ImguiHost::make_current() const { ImGui::SetCurrentContext(context_); }

void ImguiHost::set_clipboard(Clipboard clipboard) {
  clipboard_ = std::move(clipboard);
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = this;
  io.GetClipboardTextFn = [](void* user) {
    ImguiHost& host = *static_cast<ImguiHost*>(user);
    host.pasted_ = host.clipboard_.get();
    return host.pasted_.c_str();
  };
  io.SetClipboardTextFn = [](void* user, const char* text) { static_cast<ImguiHost*>(user)->clipboard_.set(text); };
}

void ImguiHost::take(std::span<const InputEvent> events) {
  ImGuiIO& io = ImGui::GetIO();
  io.MouseWheel = 0;
  for (const InputEvent& event : events) {
    std::visit(Overloaded{
                   [&](const input::Move& e) {
                     io.MousePos = {float(e.x), float(e.y)};
                   },
                   [&](const input::Button& e) { io.MouseDown[static_cast<int>(e.button)] = e.down; },
                   [&](const input::Wheel& e) { io.MouseWheel = float(e.steps); },
                   [&](const input::KeyChange& e) { io.KeysDown[static_cast<int>(e.key)] = e.down; },
                   [&](const input::Text& e) { io.AddInputCharacter(e.character); },
                   [](const input::Drop&) {},
                   [](const input::Expose&) {},
               },
               event);
  }
  io.KeyCtrl = io.KeysDown[static_cast<int>(Key::control)];
  io.KeyShift = io.KeysDown[static_cast<int>(Key::shift)];
  io.KeyAlt = io.KeysDown[static_cast<int>(Key::alt)];
}

void ImguiHost::begin_frame(int width, int height, double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(width), float(height)};
  io.DeltaTime = std::max(float(seconds), 1e-4f);
  ImGui::NewFrame();
}

}  // namespace nextview
