#include "ui/figures/uncertainty_spread.hpp"

#include <algorithm>

#include "core/evaluation/surface_error.hpp"

namespace nextview {
namespace {

struct Piece {
  double uncertainty, area;
};

/// The uncertainty that so much of the area does not exceed; the pieces are sorted by it.
double percentile(const std::vector<Piece>& pieces, double area) {
  for (const Piece& piece : pieces) {
    area -= piece.area;
    if (area <= 0.0) return piece.uncertainty;
  }
  return pieces.empty() ? 0.0 : pieces.back().uncertainty;
}

}  // namespace

UncertaintySpread uncertainty_spread(const Surface& surface) {
  UncertaintySpread spread;
  std::vector<Piece> pieces;
  for (const auto& [a, b, c] : surface.mesh.triangles) {
    const auto& corners = surface.mesh.vertices;
    const double area =
        0.5 * (corners[b] - corners[a]).cast<double>().cross((corners[c] - corners[a]).cast<double>()).norm();
    const bool seen = surface.seen[a] && surface.seen[b] && surface.seen[c];
    (seen ? spread.area_seen : spread.area_unseen) += area;
    if (seen)
      pieces.push_back({(surface.uncertainty[a] + surface.uncertainty[b] + surface.uncertainty[c]) / 3.0, area});
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.uncertainty < b.uncertainty; });
  spread.median = percentile(pieces, 0.5 * spread.area_seen);
  spread.percentile_95 = percentile(pieces, 0.95 * spread.area_seen);
  spread.end = scale_end(percentile(pieces, 0.99 * spread.area_seen));
  spread.shares.assign(50, 0.0);
  for (const Piece& piece : pieces) {
    const auto bin = static_cast<std::size_t>(piece.uncertainty / spread.end * 50.0);
    if (bin < 50 && spread.area_seen > 0.0) spread.shares[bin] += piece.area / spread.area_seen;
  }
  return spread;
}

}  // namespace nextview
