#include "core/planner/remaining_plan.hpp"

#include <algorithm>

namespace nextview {

SetCover covering_views(const NewSurfaceForecast& forecast, double left) {
  constexpr float enough = 0.8f;
  std::vector<std::vector<Covered>> views(forecast.parts.size());
  for (std::size_t v = 0; v < views.size(); ++v)
    for (std::uint32_t part = 0; part < forecast.most.size(); ++part)
      if (const float area = forecast.parts[v][part]; area > 0.0f)
        views[v].push_back({part, std::min(forecast.most[part], area / enough)});
  return least_cover(views, left);
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
