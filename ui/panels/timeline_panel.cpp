#include "ui/panels/timeline_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/file/counted.hpp"
#include "core/setting/area_text.hpp"
#include "ui/commands/branch_commands.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/view_pictures.hpp"

namespace nextview {
namespace {

// [px] on a display that does not scale
constexpr float label_width = 158, start_width = 20, picture_width = 60, picture_height = 45, picture_gap = 6,
                row_gap = 10, row_height = picture_height + 18 + row_gap;

/// What a view came to, in a few characters; in fewer below its picture, where tenths would touch the next view's.
std::string brief(const SessionSnapshot& s, const StepRecord& record, bool with_tenths) {
  const auto percent = [&](double share) {  // 99.96 % is not all of it
    if (share < 0.995 || share >= 1) return fmt::format("{:.0f} %", 100 * share);
    return with_tenths ? fmt::format("{:.1f} %", std::floor(1000 * share) / 10) : std::string("99 %");
  };
  if (record.coverage_recorded) return percent(*record.coverage_recorded);
  return s.is_evaluated() ? percent(record.coverage_visible) : area_text(record.new_surface);
}

std::string details(const SessionSnapshot& s, std::size_t view, const TimelineStep& step) {
  std::string text = fmt::format("View {}", view);
  if (!step.picture) text += "\nits capture is lost";
  if (!step.record) return text + "\nclick to go there: it is worked out then";
  const StepRecord& r = *step.record;
  text += r.view >= 0    ? fmt::format(" from {} {}{}", s.is_recording() ? "frame" : "candidate", r.view,
                                    r.overridden ? ", your choice" : "")
          : r.overridden ? ", your own"
                         : ", the start";
  text += fmt::format("\n{} of new surface", area_text(r.new_surface));
  if (s.is_evaluated())
    text +=
        fmt::format("\n{:.1f} % of the visible surface, {:.1f} % of all", 100 * r.coverage_visible, 100 * r.coverage);
  return text;
}

Image picture_of(const DepthCells& cells) {
  const auto [near, far] = depth_range(cells.depth, {});
  return depth_picture(cells.depth, {}, cells.columns, cells.rows, near, far);
}

}  // namespace

/// A branch as it is drawn.
struct TimelinePanel::Row {
  std::size_t branch;
  std::vector<const TimelineStep*> line;
  std::size_t shared = 0;  ///< views that stand in a row above
  ImVec2 corner;           ///< of the first column, on the screen
  float branches_off = 0;  ///< where the views that it shares are, from above [px, screen]

  float x(const Style& style, std::size_t view) const {  ///< of the view's left edge; 0: before the first
    return corner.x + style.px(view == 0 ? label_width
                                         : label_width + start_width + float(view - 1) * (picture_width + picture_gap));
  }
};

void TimelinePanel::go_to(const PanelContext& context, const Row& row, std::size_t views) {
  const Timeline& timeline = *context.snapshot.timeline;
  const std::pair<std::size_t, std::size_t> there(row.branch, views);
  if (dragging_ && gone_to_ == there) return;
  dragging_ = true;
  gone_to_ = there;
  context.post(command::go_to_view(views, timeline.branches.all[row.branch].name));
}

/// Name and length of a branch, and what can be done with it.
void draw_label(const PanelContext& context, const Branch& branch, bool current,
                const std::vector<const TimelineStep*>& line) {
  const SessionSnapshot& s = context.snapshot;
  const Style& style = context.style;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton("branch", {style.px(label_width - 14), style.px(picture_height)}) && !current)
    context.post(command::go_to_branch(branch.name));
  tooltip(current ? "The branch that the scan is on. Right click: rename, compare, remove."
                  : "Click: go to its end. Right click: compare, rename, remove.");
  if (ImGui::BeginPopupContextItem("what can be done")) {
    if (ImGui::MenuItem("Compare with this branch", nullptr, false, !current))
      context.post(command::compare(branch.name));
    if (ImGui::MenuItem("Rename…"))
      context.post(command::palette(fmt::format("rename-branch {} ", quoted(branch.name))));
    if (ImGui::MenuItem("Remove", nullptr, false, !current)) context.post(command::remove_branch(branch.name));
    ImGui::EndPopup();
  }
  ImFont* const font = current ? style.semi_bold : style.regular;
  ImGui::PushFont(font);
  const std::string name = shortened(branch.name, style.px(label_width - 24));
  ImGui::PopFont();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(font, font->FontSize, {start.x, start.y + style.px(3)},
               to_imgui_u32(current ? theme::ink : theme::soft_ink), name.c_str());
  std::string length = counted(line.size(), "view");
  if (!line.empty() && line.back()->record) length += ", " + brief(s, *line.back()->record, true);
  list.AddText(style.small, style.small->FontSize, {start.x, start.y + style.px(23)}, to_imgui_u32(theme::soft_ink),
               length.c_str());
}

/// A view, or with `step` null what was before the first.
void draw_cell(const PanelContext& context, const TimelineStep* step, const ImVec2& from, const ImVec2& to,
               std::size_t view, bool later) {
  const Style& style = context.style;
  const SessionSnapshot& s = context.snapshot;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_here = s.timeline->at == (step ? step->number : 0);
  if (!step) {
    const ImVec2 centre{(from.x + to.x) / 2, (from.y + to.y) / 2};
    list.AddCircleFilled(centre, style.px(5), to_imgui_u32(is_here ? theme::chosen : theme::muted));
    return;
  }
  const auto make = [&] { return picture_of(*step->picture); };
  const std::uint64_t version = (s.session << 32) + step->number;
  const ImTextureID texture =
      step->picture ? context.pictures.get(fmt::format("view {}", step->number), version, make) : nullptr;
  list.AddRectFilled(from, to, to_imgui_u32(theme::sky));
  if (texture) list.AddImage(texture, from, to);
  if (later) list.AddRectFilled(from, to, to_imgui_u32(theme::paper, 0.6));
  list.AddRect(from, to, to_imgui_u32(is_here ? theme::chosen : theme::hairline), 0, 0, style.px(is_here ? 2.5f : 1));
  const auto width_of = [&](const std::string& text) {
    return style.small->CalcTextSizeA(style.small->FontSize, FLT_MAX, 0, text.c_str()).x;
  };
  std::string text =
      step->record ? fmt::format("{} · {}", view, brief(s, *step->record, false)) : fmt::format("{}", view);
  if (width_of(text) > to.x - from.x + style.px(picture_gap))  // else it touches that of the next view
    text = fmt::format("{}", view);                            // its tooltip says the rest
  const float width = width_of(text);
  list.AddText(style.small, style.small->FontSize, {(from.x + to.x - width) / 2, to.y + style.px(1)},
               to_imgui_u32(is_here ? theme::chosen : theme::soft_ink), text.c_str());
}

void TimelinePanel::draw_cells(const PanelContext& context, const Row& row) {
  const Style& style = context.style;
  const SessionSnapshot& s = context.snapshot;
  const Timeline& timeline = *s.timeline;
  const bool current = row.branch == timeline.branches.on;
  const auto here = std::ranges::find(row.line, timeline.at, &TimelineStep::number);
  for (std::size_t view = row.shared == 0 && row.branch == 0 ? 0 : row.shared + 1; view <= row.line.size(); ++view) {
    const float width = style.px(view == 0 ? start_width - picture_gap : picture_width);
    const ImVec2 from{row.x(style, view), row.corner.y}, to{from.x + width, from.y + style.px(picture_height)};
    const TimelineStep* const step = view == 0 ? nullptr : row.line[view - 1];
    const bool later =
        current &&
        (timeline.at == 0 ? view > 0 : here != row.line.end() && row.line.begin() + std::ptrdiff_t(view) > here + 1);
    draw_cell(context, step, from, to, view, later);
    const bool pointed_at =
        ImGui::GetIO().MousePos.x > row.corner.x + ImGui::GetScrollX() + style.px(label_width - 10) &&
        ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
        ImGui::IsMouseHoveringRect(from, {to.x, to.y + style.px(16)});
    if (!pointed_at) continue;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) || (dragging_ && ImGui::IsMouseDown(ImGuiMouseButton_Left)))
      go_to(context, row, view);
    else
      ImGui::SetTooltip("%s", step ? details(s, view, *step).c_str() : "Before the first view");
  }
  if (const std::pair place(row.branch, timeline.at); current && followed_ != place) {
    followed_ = place;
    const float y = row.corner.y - ImGui::GetWindowPos().y;
    if (y < 0 || y + style.px(row_height) > ImGui::GetWindowHeight())
      ImGui::SetScrollY(y + ImGui::GetScrollY() - (ImGui::GetWindowHeight() - style.px(row_height)) / 2);
    if (here == row.line.end()) return;
    const float x = row.x(style, std::size_t(here - row.line.begin()) + 1) - ImGui::GetWindowPos().x;
    if (x < style.px(label_width) || x > ImGui::GetWindowWidth() - style.px(2 * picture_width))
      ImGui::SetScrollX(std::max(0.0f, x + ImGui::GetScrollX() - 0.6f * ImGui::GetWindowWidth()));
  }
}

void TimelinePanel::draw_row(const PanelContext& context, const Row& row) {
  const Style& style = context.style;
  const Branches& branches = context.snapshot.timeline->branches;
  ImGui::PushID(int(row.branch));
  const float middle = row.corner.y + style.px(picture_height / 2);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (row.branch > 0) {  // where it leaves the row above; between the pictures of those that lie on its way
    const float from =
        row.x(style, row.shared) + style.px(row.shared == 0 ? (start_width - picture_gap) / 2 : picture_width / 2);
    const float to = row.x(style, row.shared + 1), x = to - style.px(picture_gap / 2);
    const ImVec2 way[] = {{from, row.branches_off}, {x, row.branches_off}, {x, middle}, {to, middle}};
    list.AddPolyline(way, std::size(way), to_imgui_u32(theme::muted), 0, style.px(1.5f));
    if (row.line.size() == row.shared) list.AddCircleFilled({x, middle}, style.px(4), to_imgui_u32(theme::muted));
  }
  draw_cells(context, row);
  // Names stay where they are while the views are scrolled beneath them.
  const ImVec2 label{row.corner.x + ImGui::GetScrollX(), row.corner.y};
  list.AddRectFilled({label.x - style.px(14), label.y}, {label.x + style.px(label_width - 10), label.y + style.px(62)},
                     to_imgui_u32(theme::paper));
  ImGui::SetCursorScreenPos(label);
  draw_label(context, branches.all[row.branch], row.branch == branches.on, row.line);
  ImGui::PopID();
}

void TimelinePanel::draw(const PanelContext& context, const Rectangle& rectangle) {
  const Style& style = context.style;
  const auto& timeline = context.snapshot.timeline;
  std::size_t longest = 0;
  std::vector<Row> rows;
  for (std::size_t b = 0; timeline && b < timeline->branches.all.size(); ++b) {
    rows.push_back({b, timeline->line(timeline->branches.all[b]), 0, {}, 0});
    longest = std::max(longest, rows.back().line.size());
  }
  const float wide = style.px(label_width + start_width + float(longest) * (picture_width + picture_gap) + 24);
  const Panel panel("Timeline", rectangle, 0, wide);
  if (!timeline) return;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragging_ = false;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = style.px(row_height);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Row& row = rows[r];
    row.corner = {corner.x, corner.y + float(r) * height};
    std::size_t leaves = 0;  // the row that it shares most with
    for (std::size_t other = 0; other < r; ++other) {
      const auto shared = std::size_t(std::ranges::mismatch(row.line, rows[other].line).in1 - row.line.begin());
      if (shared > row.shared) row.shared = shared, leaves = other;
    }
    row.branches_off = rows[leaves].corner.y + style.px(picture_height + 19);
    draw_row(context, row);
  }
  ImGui::SetCursorScreenPos({corner.x, corner.y + float(rows.size()) * height});
  if (longest == 0)
    small_text(style,
               "Each view that is taken appears here. Click on one to go back to it; take another view from "
               "there, and it begins a branch.");
  else
    ImGui::Dummy({1, 1});
}

}  // namespace nextview
