#pragma once
#include <imgui.h>

#include <functional>
#include <string>

#include "ui/panels/style.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

// What is drawn over the scene, behind the panels.

inline ImVec2 at(const Eigen::Vector2d& p) { return {float(p.x()), float(p.y())}; }
/// Right above a place of the window, on paper; moved `inside` a part of it, if that is given. Returns where it is.
Rectangle draw_label(const Style& style, ImVec2 place, const std::string& text, const Colour& colour,
                     const Rectangle* inside = nullptr);
/// Away from a place, which it may not cover, with a line from there.
void draw_led_label(const Style& style, ImVec2 place, const std::string& text, const Colour& colour,
                    const Rectangle& inside);
/// Leaves out what lies beneath the legends: they have to be read. ImGui cuts by one rectangle, so it may draw twice.
void draw_beside_legends(const SceneView& view, const std::function<void()>& draw);
/// Between points of the world [m].
void draw_segment(SceneView& view, const Vector3& from, const Vector3& to, ImU32 colour, float width);

}  // namespace nextview
