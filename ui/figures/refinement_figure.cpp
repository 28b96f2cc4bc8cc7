#include "ui/figures/refinement_figure.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/file/counted.hpp"
#include "ui/charts/curve_plot.hpp"
#include "ui/figures/slice.hpp"

namespace nextview {
namespace {

/// The panel in a column (0 to 2, from the left) of the upper (0) or lower (1) row.
PageArea panel(int column, int row, double page_width, double rows_top) {
  const double width = std::floor((page_width - 4 * page_margin) / 3);
  const double height = std::floor((rows_top - 3 * page_margin) / 2);
  return {page_margin + column * (width + page_margin), page_margin + (1 - row) * (height + page_margin), width,
          height};
}

/// The widths of the openings that the slice meets, each off the opening's upper mouth.
std::vector<SliceLabel> labels_of(const RefinementPicture& picture, const GridSlice& slice) {
  std::vector<SliceLabel> labels;
  for (const Opening& opening : picture.openings) {
    const double slope = opening.along[slice.axis];
    const double along = (slice.position(picture.grid) - opening.centre[slice.axis]) / slope;
    if (slope == 0.0 || std::abs(along) > 0.5 * opening.length) continue;
    const double upwards = opening.axis[slice.up_axis()] < 0.0 ? -1.0 : 1.0;
    const double off = 0.5 * opening.depth + 4.0 * picture.grid.resolution;
    labels.push_back({opening.centre + along * opening.along + upwards * off * opening.axis,
                      fmt::format("{:g} mm", 1e3 * opening.width)});
  }
  return labels;
}

/// What all slices of the picture share.
SliceContent slice_of(const RefinementPicture& picture, const GridSlice& slice, const std::string& title,
                      SliceValue value, std::span<const Voxel> voxels) {
  SliceContent content;
  content.title = title;
  content.grid = picture.grid;
  content.slice = slice;
  content.value = value;
  content.voxels = voxels;
  content.object = picture.object;
  content.labels = labels_of(picture, slice);
  return content;
}

void paint_slices(vtkContext2D& context, const RefinementPicture& picture, double width, double top) {
  const GridSlice slice = picture.slice.value_or(default_slice(picture));
  SliceContent conventional =
      slice_of(picture, slice, "Conventional map", SliceValue::probability, picture.conventional);
  paint_slice(context, panel(0, 0, width, top), conventional);

  SliceContent gibbs = slice_of(picture, slice, "Gibbs map", SliceValue::probability, picture.gibbs);
  gibbs.unmeasured_name = "not informed";
  paint_slice(context, panel(1, 0, width, top), gibbs);

  SliceContent difference = slice_of(picture, slice, "Gibbs minus conventional", SliceValue::difference, picture.gibbs);
  difference.other = picture.conventional;
  difference.value_name = "P(Gibbs) − P(conventional)";
  difference.unmeasured_name = "in neither map";
  paint_slice(context, panel(2, 0, width, top), difference);

  SliceContent entropy =
      slice_of(picture, slice, "What stays uncertain in the Gibbs map", SliceValue::entropy, picture.gibbs);
  entropy.value_name = "entropy";
  entropy.unmeasured_name = "not informed";
  paint_slice(context, panel(0, 1, width, top), entropy);
}

/// "stationary after 50 sweeps, R-hat 0.98"
std::string verdict(const SamplerDiagnostics& d) {
  if (d.log_posterior.empty()) return "no chains";
  if (d.few_sweeps()) return counted(d.sweeps, "sweep") + ": too few to tell if stationary";
  return fmt::format("{} after {} sweeps, R-hat {:.2f}", d.stationary ? "stationary" : "not stationary", d.sweeps,
                     d.r_hat);
}

/// The log-posterior is known up to a constant: it counts from its mean over the sweeps after burn-in.
CurvePlot trace_of(const SamplerDiagnostics& d) {
  double sum = 0.0, count = 0.0;
  for (const auto& chain : d.log_posterior)
    for (std::size_t s = d.burn_in; s < chain.size(); ++s) sum += chain[s], count += 1.0;
  const double mean = count > 0 ? sum / count : 0.0;

  CurvePlot plot;
  plot.title = "Log-posterior";
  plot.remark = verdict(d);
  plot.x_label = "sweep";
  plot.y_label = "above its mean after burn-in [knats]";
  plot.whole_x = true;
  plot.x_high = std::max(2, d.sweeps);
  plot.y_low = plot.y_high = 0.0;
  for (std::size_t c = 0; c < d.log_posterior.size(); ++c) {
    Curve curve{fmt::format("chain {}", c + 1), {}, {}, {}, theme::series[c % theme::series.size()]};
    for (std::size_t s = 0; s < d.log_posterior[c].size(); ++s) {
      curve.x.push_back(double(s + 1));
      curve.y.push_back((d.log_posterior[c][s] - mean) / 1e3);
      plot.y_low = std::min(plot.y_low, curve.y.back());
      plot.y_high = std::max(plot.y_high, curve.y.back());
    }
    plot.curves.push_back(std::move(curve));
  }
  if (plot.y_low == plot.y_high) plot.y_high = plot.y_low + 1.0;
  const double margin = 0.06 * (plot.y_high - plot.y_low);
  plot.y_low -= margin;
  plot.y_high += 2 * margin;  // the part's name stands there
  if (d.burn_in > 0) plot.parts = {{0.0, double(d.burn_in), "burn-in"}};
  return plot;
}

void paint_numbers(Painter& painter, const PageArea& area, const RefinementPicture& picture) {
  paint_panel(painter, area, "Before and after");
  const double left = area.left + page_margin, right = area.right() - page_margin;
  const double before = right - 96, after = right;  // right ends of the columns
  double y = area.top() - heading_height - 22;
  painter.text(before, y, "conventional", theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::right);
  painter.text(after, y, "Gibbs", theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::right);
  const auto note = wrapped(painter, picture.numbers_note, right - left, theme::small_text);
  const double room = y - area.bottom - page_margin - (note.empty() ? 0.0 : 14.0 + 18.0 * double(note.size()));
  const double row = std::min(40.0, room / double(std::max<std::size_t>(1, picture.numbers.size())));
  for (const RefinementNumber& number : picture.numbers) {
    painter.line(left, y - 8, right, y - 8, 1, theme::hairline);
    y -= row;
    const double baseline = y + 0.5 * row - 15;
    painter.text(left, baseline, number.label, theme::text, theme::ink);
    if (!number.unit.empty())
      painter.text(left + painter.text_width(number.label, theme::text) + 6, baseline, "[" + number.unit + "]",
                   theme::small_text, theme::soft_ink);
    painter.text(before, baseline, number.before, theme::text, theme::ink, TextWeight::regular, TextAlign::right);
    painter.text(after, baseline, number.after, theme::text, theme::ink, TextWeight::semi_bold, TextAlign::right);
  }
  for (std::size_t i = 0; i < note.size(); ++i)
    painter.text(left, area.bottom + 14 + 18.0 * double(note.size() - 1 - i), note[i], theme::small_text,
                 theme::soft_ink);
}

}  // namespace

GridSlice default_slice(const RefinementPicture& picture) {
  if (!picture.openings.empty()) return slice_across(picture.openings.front(), picture.grid);
  return slice_of_largest_difference(picture.grid, picture.conventional, picture.gibbs);
}

Image draw_refinement_figure(RenderTarget& target, const RefinementPicture& picture) {
  constexpr int width = 1600, height = 1000;
  const std::size_t voxels = picture.grid.voxel_count();
  if (picture.conventional.size() != voxels || picture.gibbs.size() != voxels)
    throw std::invalid_argument(fmt::format("refinement figure: {} and {} voxels for a grid of {}",
                                            picture.conventional.size(), picture.gibbs.size(), voxels));
  return draw_page(target, {width, height}, [&](vtkContext2D& context) {
    Painter painter(context);
    const double top = height - paint_title(painter, width, height, picture.title, picture.remark, picture.caption);
    paint_slices(context, picture, width, top);
    paint_curve_plot(context, panel(1, 1, width, top), trace_of(picture.diagnostics));
    paint_numbers(painter, panel(2, 1, width, top), picture);
  });
}

}  // namespace nextview
