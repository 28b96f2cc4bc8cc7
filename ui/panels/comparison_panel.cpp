#include "ui/panels/comparison_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/file/counted.hpp"
#include "core/planner/way_text.hpp"
#include "core/setting/area_text.hpp"
#include "core/setting/entropy_text.hpp"
#include "ui/commands/branch_commands.hpp"

namespace nextview {
namespace {

double path_of(const std::vector<StepRecord>& records) {
  double path = 0.0;
  for (const StepRecord& record : records) path += record.motion.distance;
  return path;
}

double motion_seconds(const std::vector<StepRecord>& records) {
  double seconds = 0.0;
  for (const StepRecord& record : records) seconds += record.motion.seconds;
  return seconds;
}

double new_surface(const std::vector<StepRecord>& records) {
  double surface = 0.0;
  for (const StepRecord& record : records) surface += record.new_surface;
  return surface;
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

void add_settings(std::vector<Difference>& result, const SessionSnapshot& here, const SessionSnapshot& there) {
  Configuration a = here.configuration, b = there.configuration;
  const auto ours = settings(a), theirs = settings(b);
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (ours[i].text() != theirs[i].text()) result.push_back({ours[i].key, ours[i].text(), theirs[i].text()});
}

/// "17 views, 98.2 %".
std::string summary(const SessionSnapshot& s, const std::vector<const TimelineStep*>& line) {
  const std::string views = counted(line.size(), "view");
  const bool covers = s.is_evaluated() && !line.empty() && line.back()->record;
  return covers ? fmt::format("{}, {:.1f} %", views, 100 * line.back()->record->coverage_visible) : views;
}

/// The choice of the branch, to begin with.
void draw_choice(const PanelContext& context) {
  const auto& timeline = context.snapshot.timeline;
  if (!timeline || timeline->branches.all.size() < 2)
    return small_text(context.style,
                      "There is one branch so far. Go back to a view (Timeline, Page Up) and take another one from "
                      "there, or begin a branch here [B]; then the two can be compared.");
  small_text(context.style, "Compare with");
  for (const Branch& branch : timeline->branches.all) {
    if (branch == timeline->branches.current()) continue;
    ImGui::PushID(int(branch.id));
    if (ImGui::Selectable("##branch")) context.post(command::compare(branch.name));
    ImGui::SameLine(context.style.px(16));
    ImGui::TextUnformatted(branch.name.c_str());  // which may have what means something in a label
    ImGui::SameLine();
    ImGui::TextDisabled("%s", summary(context.snapshot, timeline->line(branch)).c_str());
    ImGui::PopID();
  }
}

void draw_cells(const Difference& row) {
  ImGui::TableNextRow();
  for (const std::string* text : {&row.name, &row.here, &row.there}) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text->c_str());
    if (ImGui::IsItemHovered() && ImGui::CalcTextSize(text->c_str()).x > ImGui::GetContentRegionAvail().x)
      tooltip(*text);
  }
}

}  // namespace

std::vector<Difference> differences(const SessionSnapshot& here, const SessionSnapshot& there) {
  std::vector<Difference> result;
  add_settings(result, here, there);
  const auto add = [&](const char* name, const std::function<std::string(const SessionSnapshot&)>& text) {
    result.push_back({name, text(here), text(there)});
  };
  add("views", [](const SessionSnapshot& s) { return std::to_string(s.records.size()); });
  if (here.records.empty() || there.records.empty()) return result;
  if (here.is_evaluated()) {
    add("coverage of visible surface",
        [](const SessionSnapshot& s) { return percent(s.records.back().coverage_visible); });
    add("coverage of all surface", [](const SessionSnapshot& s) { return percent(s.records.back().coverage); });
  }
  const double seen_here = new_surface(here.records), seen_there = new_surface(there.records);
  const double most = std::max(seen_here, seen_there);
  result.push_back({"surface seen", area_text(seen_here, most), area_text(seen_there, most)});
  add("expected to be left", [](const SessionSnapshot& s) {
    const auto& left = s.records.back().surface_left;
    return left ? percent(*left) : std::string("not predicted");
  });
  add("unmeasured entropy (Eq. 18)", [](const SessionSnapshot& s) { return entropy_text(s.records.back().entropy); });
  add("total entropy, ΣH(p)", [](const SessionSnapshot& s) { return entropy_text(s.records.back().total_entropy); });
  add("path", [&](const SessionSnapshot& s) { return way_text(path_of(s.records), here.state.known.map.grid()); });
  add("time of the robot", [](const SessionSnapshot& s) { return fmt::format("{:.0f} s", motion_seconds(s.records)); });
  return result;
}

void draw_comparison_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Compare", rectangle);
  const SessionSnapshot& s = context.snapshot;
  if (!s.compared) return draw_choice(context);
  const Branches& branches = s.timeline->branches;
  const Branch& other = branches.all[branches.find(s.compared->branch)];
  small_text(context.style, fmt::format("They have {} in common.", counted(s.timeline->in_common(other), "view")));
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - context.style.px(110));
  if (ImGui::SmallButton("Stop comparing")) context.post(command::stop_comparing());
  ImGui::PushFont(context.style.small);
  if (ImGui::BeginTable("differences", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("");
    draw_cells({"", branches.current().name, other.name});
    for (const Difference& row : differences(s, *s.compared->snapshot)) draw_cells(row);
    ImGui::EndTable();
  }
  ImGui::PopFont();
}

}  // namespace nextview
