#include "ui/workbench/timeline.hpp"

#include <algorithm>

namespace nextview {

std::vector<const TimelineStep*> Timeline::line(std::uint32_t number) const {
  std::vector<const TimelineStep*> line;
  while (number > 0) {
    const auto step = std::ranges::lower_bound(steps, number, {}, &TimelineStep::number);
    if (step == steps.end() || step->number != number) break;
    line.push_back(&*step);
    number = step->after;
  }
  std::ranges::reverse(line);
  return line;
}

std::size_t Timeline::in_common(const Branch& branch) const {
  const auto a = line(branch), b = line(branches.current());
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace nextview
