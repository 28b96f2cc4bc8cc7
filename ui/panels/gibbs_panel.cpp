#include "ui/panels/gibbs_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/file/counted.hpp"
#include "core/setting/entropy_text.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/gibbs_commands.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/panels/plot.hpp"

namespace nextview {
namespace {

constexpr std::size_t max_points = 200;  ///< of a curve: more do not show

void plot(const PanelContext& context, const ChartContent& chart, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Rectangle place{corner.x, corner.y, ImGui::GetContentRegionAvail().x, context.style.px(height)};
  draw_plot(context.style, chart, place);
  ImGui::Dummy({float(place.width), float(place.height)});
}

/// The log-posterior of each chain after each sweep, less the highest.
void draw_traces(const PanelContext& context, const SamplerDiagnostics& d) {
  double highest = -1e300;
  for (const auto& chain : d.log_posterior)
    for (const double value : chain) highest = std::max(highest, value);
  ChartContent chart{"Log-posterior, below its highest [knats]", "sweep", "", "", "knats", {}, {}, true};
  for (std::size_t c = 0; c < d.log_posterior.size(); ++c) {
    ChartSeries series{fmt::format("chain {}", c + 1), {}, {}};
    const auto& chain = d.log_posterior[c];
    const std::size_t stride = chain.size() / max_points + 1;
    for (std::size_t k = 0; k < chain.size(); k += stride) {
      series.x.push_back(double(k + 1));
      series.y.push_back((chain[k] - highest) / 1e3);
    }
    chart.series.push_back(std::move(series));
  }
  plot(context, chart, 150);
}

void draw_stationarity(const PanelContext& context, const SamplerDiagnostics& d) {
  const Colour good = theme::series[2];
  if (d.stationary)
    small_text(
        context.style,
        fmt::format("Stationary after {} of {}.", counted(d.sweeps, "sweep"), counted(d.log_posterior.size(), "chain")),
        good);
  else if (d.too_short_to_tell())
    small_text(context.style, d.warning + ". Refine the map to know.");
  else
    small_text(context.style, d.warning, theme::chosen);
  if (!ImGui::BeginTable("stationarity", 2)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.style.px(124));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::PushFont(context.style.small);
  if (!d.few_sweeps()) {
    table_row("R-hat", fmt::format("{:.3f} (under 1.05)", d.r_hat),
              "Split R-hat of the log-posterior: 1 if the chains agree");
    table_row("trend |z|", fmt::format("{:.1f} (under 2.58)", d.trend), "Geweke's statistic of the log-posterior");
    table_row("effective samples", fmt::format("{:.0f}", d.effective_samples), "Of the log-posterior");
  }
  table_row("voxels in dispute", fmt::format("{} of {}", d.disagreeing_voxels, d.informed_voxels),
            "Informed voxels whose mean differs by over 0.5 between two chains");
  table_row("merged rays", fmt::format("{} of {}", d.merged_rays, d.measured_rays));
  if (!context.window.presentation.demo) table_row("time", fmt::format("{:.1f} s", d.build_seconds + d.sample_seconds));
  ImGui::PopFont();
  ImGui::EndTable();
}

/// How many informed voxels have which probability, before and after.
void draw_histograms(const PanelContext& context, const RefinementChange& change) {
  ChartContent chart{"Voxels by p, log10 of their number", "p", "", "", "", {}, {}, false};
  for (const auto& [name, counts] : {std::pair{"conventional", &change.before}, {"Gibbs", &change.after}}) {
    ChartSeries series{name, {}, {}};
    for (std::size_t b = 0; b < counts->size(); ++b) {
      series.x.push_back((double(b) + 0.5) / double(counts->size()));
      series.y.push_back(std::log10(1.0 + double((*counts)[b])));
    }
    chart.series.push_back(std::move(series));
  }
  plot(context, chart, 150);
}

void draw_changes(const PanelContext& context, const RefinementChange& change) {
  small_text(context.style,
             fmt::format("{:.0f} thousand voxels are of another class than in the conventional map; the total entropy "
                         "went from {} to {}.",
                         double(change.changed_class) / 1e3, entropy_text(change.entropy_before / std::numbers::ln2),
                         entropy_text(change.entropy_after / std::numbers::ln2)));
}

void draw_before_and_after(const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  constexpr std::array names = {"before", "after", "difference"};
  const bool difference = layers.colouring == VoxelColouring::by_difference;
  const std::size_t now = difference ? 2 : layers.map == MapChoice::gibbs ? 1 : 0;
  const auto pressed = segmented(context, "before and after", names, now);
  if (!pressed) return;
  context.post(command::voxel_map(*pressed == 0 ? MapChoice::conventional : MapChoice::gibbs));
  if (*pressed == 2) context.post(command::voxel_colour(VoxelColouring::by_difference));
  if (*pressed != 2 && difference) context.post(command::voxel_colour(VoxelColouring::by_probability));
}

}  // namespace

void GibbsPanel::draw_controls(const PanelContext& context) {
  const Style& style = context.style;
  const auto& sampler = context.snapshot.configuration.gibbs.sampler;
  if (chains_ == 0) chains_ = sampler.chains;
  if (sweeps_ == 0) sweeps_ = sampler.sweeps;
  const auto number = [&](const char* id, const char* name, int& value, const Argument& argument) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name);
    ImGui::SameLine(style.px(96));
    ImGui::SetNextItemWidth(style.px(110));
    double typed = value;
    if (ImGui::InputDouble(id, &typed, 1, 100, "%.0f")) {
      value = static_cast<int>(std::clamp(typed, argument.low, argument.high));
      out_of_bounds_ =
          typed == value ? "" : fmt::format("{} are whole, from {:.0f} to {:.0f}.", name, argument.low, argument.high);
    }
    tooltip(argument.help + "; of the next run alone: it changes no setting, and keeps the scan");
  };
  const auto& refine = command::refine;
  number("##chains", "Chains", chains_, refine.arguments()[0]);
  number("##sweeps", "Sweeps", sweeps_, refine.arguments()[1]);
  const float gap = style.px(6), width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(!refine.available(context.state()));
  if (icon_button(style, Icon::play, "Refine the map", true, width)) context.post(refine(chains_, sweeps_));
  ImGui::EndDisabled();
  tooltip(help_of(context, refine));
  ImGui::SameLine(0, gap);
  const bool paused = context.progress.paused;
  command_button(context, paused ? command::resume_refinement : command::pause_refinement,
                 paused ? Icon::play : Icon::pause, paused ? "Resume" : "Pause", false, width);
  if (!out_of_bounds_.empty()) small_text(style, out_of_bounds_, theme::chosen);
}

void GibbsPanel::draw(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Gibbs", rectangle, 0, context.style.px(right_panel_width));
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return;
  draw_controls(context);
  if (context.progress.refining) {
    ImGui::Spacing();
    if (context.progress.sampler) {
      small_text(context.style, counted(context.progress.sampler->sweeps, "sweep") + " so far");
      draw_traces(context, *context.progress.sampler);
    }
    return;
  }
  if (!s.gibbs)
    return small_text(context.style,
                      "No Gibbs map yet. It is the mean over whole maps drawn from the posterior of all rays, without "
                      "the independence assumptions of the conventional map.");
  if (s.gibbs->views < s.records.size())
    small_text(context.style, fmt::format("This is the map of {}: refine again.", first_views(s.gibbs->views)),
               theme::chosen);
  draw_stationarity(context, s.gibbs->posterior->diagnostics);
  draw_before_and_after(context);
  draw_changes(context, s.gibbs->change);
  draw_histograms(context, s.gibbs->change);
  draw_traces(context, s.gibbs->posterior->diagnostics);
}

}  // namespace nextview
