#include "core/planner/remaining_plan.hpp"

#include <algorithm>

namespace nextview {

std::vector<std::size_t> covering_views(const NewSurfaceForecast& forecast, double left) {
  std::vector<std::size_t> chosen;
  std::vector<float> shown(forecast.part_count, 0.0f);
  double still_left = forecast.all;
  while (still_left > left) {
    double most = 0.0;
    std::size_t best = 0;
    for (std::size_t v = 0; v < forecast.parts.size(); ++v) {
      double more = 0.0;
      for (std::size_t p = 0; p < forecast.parts[v].size(); ++p)
        more += std::max(0.0f, forecast.parts[v][p] - shown[p]);
      if (more > most) most = more, best = v;
    }
    if (!(most > 1e-9 * forecast.all)) break;  // but for rounding, nothing is left
    chosen.push_back(best);
    for (std::size_t p = 0; p < shown.size(); ++p) shown[p] = std::max(shown[p], forecast.parts[best][p]);
    still_left -= most;
  }
  return chosen;
}

double short_way(const Vector3& from, std::vector<Vector3> stops) {
  std::vector<Vector3> way = {from};
  while (!stops.empty()) {
    const auto nearest =
        std::ranges::min_element(stops, {}, [&](const Vector3& stop) { return (stop - way.back()).squaredNorm(); });
    way.push_back(*nearest);
    stops.erase(nearest);
  }
  // Beyond the last stop there is no way to go.
  const auto length = [&](std::size_t a, std::size_t b) { return b < way.size() ? (way[a] - way[b]).norm() : 0.0; };
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (std::size_t i = 1; i + 1 < way.size(); ++i)
      for (std::size_t k = i + 1; k < way.size(); ++k) {
        const double now = length(i - 1, i) + length(k, k + 1);
        const double turned = length(i - 1, k) + length(i, k + 1);
        if (turned > now - 1e-9) continue;
        std::reverse(way.begin() + std::ptrdiff_t(i), way.begin() + std::ptrdiff_t(k) + 1);
        is_shorter = true;
      }
  }
  double whole = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) whole += length(i - 1, i);
  return whole;
}

}  // namespace nextview
