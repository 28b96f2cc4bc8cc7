#include "ui/figures/ranking.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <numeric>

#include "ui/painter.hpp"

namespace nextview {
namespace {

constexpr double row = 25.0, bar = 15.0, name_width = 64.0, number_width = 74.0, margin = 16.0;  // [px]

}  // namespace

vtkStandardNewMacro(Ranking);

std::vector<std::size_t> ranked(const RankingContent& content) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < content.scores.size(); ++i) {
    if (std::find(content.visited.begin(), content.visited.end(), i) == content.visited.end()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return content.scores[a] > content.scores[b]; });
  return order;
}

bool Ranking::Paint(vtkContext2D* context) {
  Painter painter(*context);
  double at = y + height - 30;
  const std::string unit = content.unit.empty() ? "" : " [" + content.unit + "]";
  painter.text(x + margin, at, content.title + unit, theme::caption, theme::ink, TextWeight::semi_bold);

  std::vector<std::size_t> order = ranked(content);
  if (order.empty()) return true;
  const double low = content.scores[order.back()], high = content.scores[order.front()];
  const double room = at - y - (content.note.empty() ? margin : margin + row);
  const auto rows = std::min(order.size(), static_cast<std::size_t>(std::max(1.0, room / row)));
  const auto chosen = content.chosen ? std::find(order.begin(), order.end(), *content.chosen) : order.end();
  if (chosen != order.end() && chosen >= order.begin() + rows) order[rows - 1] = *chosen;
  const double full = width - 2 * margin - name_width - number_width;
  for (std::size_t i = 0; i < rows; ++i) {
    const double score = content.scores[order[i]];
    const bool strong = content.chosen == order[i];
    at -= row;
    painter.text(x + margin, at, fmt::format("view {}", order[i]), theme::small_text,
                 strong ? theme::chosen : theme::ink, strong ? TextWeight::semi_bold : TextWeight::regular);
    const double length = high > 0 ? std::clamp(score / high, 0.0, 1.0) * full : 0.0;
    painter.box(x + margin + name_width, at, std::max(1.0, length), bar,
                strong ? theme::chosen : ColourMap::score().at(score, low, high));
    painter.text(x + width - margin, at, short_number(score), theme::small_text, theme::ink, TextWeight::regular,
                 TextAlign::right);
  }
  if (!content.note.empty()) painter.text(x + margin, y + 12, content.note, theme::small_text, theme::soft_ink);
  return true;
}

}  // namespace nextview
