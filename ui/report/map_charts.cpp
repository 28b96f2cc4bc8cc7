// Charts of what a study says of maps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/file/counted.hpp"
#include "ui/report/study_chart_parts.hpp"

namespace nextview {
namespace {

/// With the most views there are.
std::optional<StudySetting> maps_setting(const SummaryTable& table, const std::string& measure) {
  auto all = table.settings(StudyPart::maps, measure);
  if (all.empty()) return std::nullopt;
  const auto most = table.objects(all.front(), measure).size() * table.methods(all.front(), measure).size();
  std::erase_if(all, [&](const StudySetting& s) {
    return table.objects(s, measure).size() * table.methods(s, measure).size() < most;
  });
  return *std::ranges::max_element(all, {}, &StudySetting::views);
}

std::string views_of(const StudySetting& setting) { return counted(std::size_t(setting.views), "view"); }
std::string views_and_sensor(const StudySetting& setting) {
  return views_of(setting) + ", " + in_words(setting.sensor);
}

/// A row a map, a column a sensor, each the mean over the objects.
StudyChart by_sensor(const SummaryTable& table, const Sheet& sheet, const std::string& measure, MatrixPlot plot) {
  // Those of one block and number of views, under which most sensors and maps were tried.
  std::map<std::pair<std::size_t, int>, std::vector<StudySetting>> together;
  for (const StudySetting& setting : table.settings(StudyPart::maps, measure))
    together[{setting.block, setting.views}].push_back(setting);
  if (together.empty()) return std::nullopt;
  const auto most = std::ranges::max_element(together, {}, [&](const auto& entry) {
    return entry.second.size() * table.methods(entry.second.front(), measure).size();
  });
  plot.title += ", " + counted(std::size_t(most->first.second), "view");
  for (const StudySetting& setting : most->second) {
    plot.columns.push_back(in_words(setting.sensor));
    for (const std::string& method : table.methods(setting, measure))
      if (std::ranges::find(plot.rows, in_words(method)) == plot.rows.end()) plot.rows.push_back(in_words(method));
  }
  for (const std::string& row : plot.rows) {
    auto& values = plot.values.emplace_back();
    for (const StudySetting& setting : most->second) {
      values.emplace_back();
      for (const std::string& method : table.methods(setting, measure))
        if (in_words(method) == row) values.back() = table.value(setting, mean_object, method, measure);
    }
  }
  const double height = 120 + 28.0 * double(plot.rows.size());
  return one_matrix(plot, sheet, height);
}

}  // namespace

StudyChart divergence_by_object(const SummaryTable& table, const Sheet& sheet) {
  const auto setting = maps_setting(table, "d_kl[nats]");
  if (!setting) return std::nullopt;
  MatrixPlot plot;
  plot.title = fmt::format("D_KL to the truth over all visited voxels, {} [knats]", views_and_sensor(*setting));
  plot.note = "darker: less, better";
  plot.digits = 0;
  plot.dark_is_high = false;
  return by_object(table, sheet, *setting, "d_kl[nats]", plot, 1e3);
}

StudyChart log_loss_by_object(const SummaryTable& table, const Sheet& sheet) {
  const auto setting = maps_setting(table, "log_loss_near_surface[nats]");
  if (!setting) return std::nullopt;
  MatrixPlot plot;
  plot.title = fmt::format("Log loss within 3 voxels of the surface, {} [nats per voxel]", views_and_sensor(*setting));
  plot.note = "darker: less, better. Truth: the surface touches the voxel";
  plot.digits = 3;
  plot.dark_is_high = false;
  return by_object(table, sheet, *setting, "log_loss_near_surface[nats]", plot);
}

StudyChart log_loss_by_sensor(const SummaryTable& table, const Sheet& sheet) {
  MatrixPlot plot;
  plot.title = "Log loss within 3 voxels of the surface by noise and field of view [nats per voxel]";
  plot.note = "darker: less, better. Truth: the surface touches the voxel";
  plot.digits = 3;
  plot.dark_is_high = false;
  return by_sensor(table, sheet, "log_loss_near_surface[nats]", plot);
}

StudyChart openings_by_sensor(const SummaryTable& table, const Sheet& sheet) {
  MatrixPlot plot;
  plot.title = "Rows of slots and bores with an open line through [%]";
  plot.note = "darker: more";
  plot.dark_is_high = true;
  plot.digits = 0;
  return by_sensor(table, sheet, "rows_open[%]", plot);
}

StudyChart openings_by_width(const SummaryTable& table, const Sheet& sheet) {
  const std::pair<const char*, const char*> measures[] = {
      {"rows_open_by_width[%]", "Open rows of slots and bores by their width"},
      {"leaks_by_width[%]", "Rows called open through solid wall beside them"}};
  const auto setting = maps_setting(table, measures[0].first);
  if (!setting) return std::nullopt;
  constexpr double height = 400;
  const double width = chart_width(sheet);
  VectorDrawing drawing(width, 2 * height, sheet.look);
  for (int i = 0; i < 2; ++i) {
    Plot plot = courses(table, *setting, measures[i].first);
    for (PlotSeries& series : plot.series) series.spread.clear();
    plot.title =
        fmt::format("{}: {}, {}", measures[i].second, scope(table, *setting, measures[i].first), views_of(*setting));
    plot.x_label = "width [mm]";
    plot.y_label = "rows [%]";
    plot.y_high = i == 0 ? std::optional(100.0) : std::nullopt;
    draw_plot(drawing, {0, i * height, width, height}, plot);
  }
  return drawing;
}

StudyChart reliability(const SummaryTable& table, const Sheet& sheet) {
  // Bins are told of the mean over objects alone; the main measure has the objects.
  const auto setting = maps_setting(table, main_measure(StudyPart::maps));
  if (!setting || table.methods(*setting, "reliability_true").empty()) return std::nullopt;
  Plot plot = courses(table, *setting, "reliability_true", 0.01);
  plot.whole_x = false;
  plot.title = fmt::format("Reliability near the surface: {}, {}",
                           scope(table, *setting, main_measure(StudyPart::maps)), views_of(*setting));
  plot.x_label = "probability that the map says [%]";
  plot.y_label = "voxels that the surface touches [%]";
  plot.diagonal = true;
  plot.x_low = 0.0, plot.x_high = 100.0, plot.y_low = 0.0, plot.y_high = 100.0;
  const std::vector<std::string> methods = table.methods(*setting, "reliability_true");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto said = table.course(*setting, mean_object, methods[m], "reliability_said");
    PlotSeries& series = plot.series[m];
    for (std::size_t i = 0; i < series.x.size(); ++i) series.x[i] = 100.0 * said.at(i).mean;
    series.spread.clear();
  }
  return one_plot(plot, sheet, 520);
}

/// Each chain in a colour of its own, the default one strong.
void tell_apart(Plot& plot) {
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    PlotSeries& series = plot.series[i];
    series.spread.clear();
    series.colour = i < theme::series.size() ? theme::series[i] : theme::ink;
    series.thickness = i == 0 ? 2.5 : 1.75;
    series.dashed = i >= 3;
  }
}

/// Under which the most chains were tried.
StudyChart stationarity(const SummaryTable& table, const Sheet& sheet) {
  const std::string trace = "log_posterior_below_last[nats]", divergence = "d_kl_of_mean[nats]";
  auto settings = table.settings(StudyPart::maps, trace);
  if (settings.empty()) return std::nullopt;
  const StudySetting setting =
      *std::ranges::max_element(settings, {}, [&](const StudySetting& s) { return table.methods(s, trace).size(); });
  constexpr double height = 420;
  const double width = chart_width(sheet);
  VectorDrawing drawing(width, 2 * height, sheet.look);
  Plot way = courses(table, setting, trace, 1e3);
  for (PlotSeries& series : way.series)
    for (double& y : series.y) y = std::abs(y);
  way.title = "How far a chain's log-posterior is from where it ends: mean over objects, " + in_words(setting.sensor);
  way.x_label = "sweeps";
  way.y_label = "difference of log-posteriors [knats]";
  way.logarithmic_y = true;
  way.y_low = 0.1;
  Plot change = courses(table, setting, divergence);
  change.title = "What a sweep changes of the running mean: mean over objects, " + in_words(setting.sensor);
  change.x_label = "sweeps";
  change.y_label = "D_KL between successive means [nats]";
  change.logarithmic_y = true;
  tell_apart(way), tell_apart(change);
  draw_plot(drawing, {0, 0, width, height}, way);
  draw_plot(drawing, {0, height, width, height}, change);
  return drawing;
}

}  // namespace nextview
