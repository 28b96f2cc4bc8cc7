#include "ui/figures/ranking.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <numeric>

#include "ui/drawing/painter.hpp"

namespace nextview {
namespace {

constexpr double row = 25.0, bar = 15.0, name_width = 64.0, number_width = 74.0, margin = 16.0;  // [px]

void heading(Painter& painter, double right, double y, const std::string& text) {
  painter.text(right, y, text, theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::right);
}

void number(Painter& painter, double right, double y, const std::string& text) {
  painter.text(right, y, text, theme::small_text, theme::ink, TextWeight::regular, TextAlign::right);
}

}  // namespace

vtkStandardNewMacro(RankingItem);

std::vector<std::size_t> ranked(const RankingContent& content) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < content.scores.size(); ++i) {
    if (std::find(content.taken.begin(), content.taken.end(), i) == content.taken.end()) order.push_back(i);
  }
  const auto& key = content.utilities.empty() ? content.scores : content.utilities;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] > key[b]; });
  return order;
}

bool RankingItem::Paint(vtkContext2D* context) {
  Painter painter(*context);
  double at = y + height - 30;
  painter.text(x + margin, at, content.title, theme::caption, theme::ink, TextWeight::semi_bold);
  std::vector<std::size_t> order = ranked(content);
  if (order.empty()) return true;

  at -= row;
  const double utility_width = content.utilities.empty() ? 0.0 : number_width;
  const double score_right = x + width - margin - utility_width;
  const std::string unit = content.unit.empty() ? "" : " [" + content.unit + "]";
  heading(painter, score_right, at, content.score_name + unit);
  if (utility_width > 0) heading(painter, x + width - margin, at, "utility");

  const double room = at - y - (content.note.empty() ? margin : margin + row);
  const auto rows = std::min(order.size(), static_cast<std::size_t>(std::max(1.0, room / row)));
  const auto chosen = content.chosen ? std::find(order.begin(), order.end(), *content.chosen) : order.end();
  if (chosen != order.end() && chosen >= order.begin() + std::ptrdiff_t(rows)) order[rows - 1] = *chosen;
  const auto [low, high] = score_range(order);
  const double full = score_right - number_width - (x + margin + name_width);
  for (std::size_t i = 0; i < rows; ++i) {
    at -= row;
    const double score = content.scores[order[i]];
    const bool strong = content.chosen == order[i];
    painter.text(x + margin, at, fmt::format("view {}", order[i]), theme::small_text,
                 strong ? theme::chosen : theme::ink, strong ? TextWeight::semi_bold : TextWeight::regular);
    painter.box(x + margin + name_width, at, std::max(1.0, high > 0 ? score / high * full : 0.0), bar,
                strong ? theme::chosen : ColourMap::score().at(score, low, high));
    number(painter, score_right, at, short_number(score));
    if (utility_width > 0) number(painter, x + width - margin, at, fmt::format("{:.4f}", content.utilities[order[i]]));
  }
  if (!content.note.empty()) painter.text(x + margin, y + 12, content.note, theme::small_text, theme::soft_ink);
  return true;
}

std::pair<double, double> RankingItem::score_range(const std::vector<std::size_t>& candidates) const {
  double low = content.scores[candidates.front()], high = low;
  for (const std::size_t candidate : candidates) {
    low = std::min(low, content.scores[candidate]);
    high = std::max(high, content.scores[candidate]);
  }
  return {low, high};
}

}  // namespace nextview
