#include "core/gibbs/read_out.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nextview {
namespace {

/// Log-odds of a posterior mean, kept within what some hundred sweeps can tell.
double kept_log_odds(double p) { return log_odds(std::clamp(p, 1e-4, 1.0 - 1e-4)); }

}  // namespace

std::vector<RayCount> ray_counts(const RayLists& lists) {
  std::vector<RayCount> counts(lists.grid().voxel_count());
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t v) {
    const auto voxel = static_cast<std::uint32_t>(v);
    for (const RayLists::FrontEntry entry : lists.front(voxel)) counts[v].passed += float(lists.weight(entry.ray()));
    for (const RayLists::NearEntry entry : lists.near(voxel)) {
      const float weight = static_cast<float>(lists.weight(entry.ray));
      switch (lists.incidence(entry.incidence).place) {
        case RayLists::Place::in_front:
          counts[v].passed += weight;
          break;
        case RayLists::Place::at_range:
          counts[v].ended += weight;
          break;
        case RayLists::Place::behind:
          break;
      }
    }
  });
  return counts;
}

/// Sums over the voxels around one: those that share a face with it, and all 26.
struct ReadOutFeatures::Around {
  struct Sums {
    double uninformed = 0.0, occupied = 0.0, upper = 0.0;
    double uncrossed = 0.0;  ///< voxels that no measured ray crosses
    double ended = 0.0;      ///< shares of the voxels' rays that end there
    double log_ended = 0.0;  ///< log(1 + rays that end there)
  };
  Sums faces, all;
  double face_log_odds = 0.0, log_crossed = 0.0;
};

ReadOutFeatures::ReadOutFeatures(const GibbsPosterior& posterior, std::span<const RayCount> rays)
    : posterior_(posterior), rays_(rays) {}

ReadOutFeatures::Around ReadOutFeatures::around(std::uint32_t voxel) const {
  const VoxelGrid& grid = posterior_.grid;
  const Eigen::Vector3i centre = grid.cell(voxel);
  Around around;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int steps = std::abs(x) + std::abs(y) + std::abs(z);
        const Eigen::Vector3i cell = centre + Eigen::Vector3i(x, y, z);
        if (steps == 0 || !grid.contains(cell)) continue;
        const std::uint32_t v = grid.index(cell);
        const bool informed = posterior_.informed[v] != 0;
        const double crossed = rays_[v].crossed();
        const Around::Sums here{
            informed ? 0.0 : 1.0,       informed ? posterior_.occupied[v] : 0.0, informed ? posterior_.upper[v] : 0.0,
            crossed == 0.0 ? 1.0 : 0.0, rays_[v].ended / (crossed + 0.1),        std::log1p(rays_[v].ended)};
        const auto add = [&](Around::Sums& sums) {
          sums.uninformed += here.uninformed;
          sums.occupied += here.occupied;
          sums.upper += here.upper;
          sums.uncrossed += here.uncrossed;
          sums.ended += here.ended;
          sums.log_ended += here.log_ended;
        };
        add(around.all);
        around.log_crossed += std::log1p(crossed);
        if (steps > 1) continue;
        add(around.faces);
        if (informed) around.face_log_odds += kept_log_odds(posterior_.occupied[v]);
      }
  return around;
}

ReadOutFeatures::Vector ReadOutFeatures::of(std::uint32_t voxel) const {
  const double occupied = kept_log_odds(posterior_.occupied[voxel]), upper = kept_log_odds(posterior_.upper[voxel]);
  const RayCount& rays = rays_[voxel];
  const double ended = std::log((rays.ended + 0.05) / (rays.passed + 0.05));
  const Around a = around(voxel);
  // Divided so that all are of a size.
  return {1.0,
          occupied,
          upper,
          occupied * occupied / 10.0,
          upper * upper / 10.0,
          a.faces.uninformed,
          a.all.uninformed,
          a.faces.occupied,
          a.all.occupied,
          a.faces.upper,
          a.all.upper,
          a.face_log_odds / 6.0,
          std::log1p(rays.crossed()),
          ended,
          ended * ended / 10.0,
          a.faces.uncrossed,
          a.all.uncrossed,
          a.faces.ended,
          a.all.ended,
          a.log_crossed / 26.0,
          std::log1p(rays.ended),
          a.all.log_ended / 26.0,
          a.faces.log_ended / 6.0};
}

const ReadOutWeights& fitted_read_out() {
  static const ReadOutWeights weights{
      {-4.6952, 0.9472,  -0.3000, -0.7803, 0.2314, -1.2713, -0.6923, 0.7293,  1.9102, 0.5324, -2.1812, 0.6013,
       0.7265,  -0.3003, -0.2799, 0.7093,  1.1223, 0.9690,  -0.1375, -0.9224, 1.3527, 0.4654, 1.0395},
      {-6.2338, -0.3419, 0.8046, 0.1005, -0.3274, -0.5272, 0.2193,  0.1279, 3.1746, -0.3930, -2.8634, 0.4597,
       -2.3922, -0.0196, 0.0135, 1.2608, 0.3192,  1.4571,  -0.6929, 0.2795, 0.8003, 3.1226,  -0.5686}};
  return weights;
}

void read_out(GibbsPosterior& posterior, std::span<const RayCount> rays, const ReadOutWeights& weights) {
  const ReadOutFeatures features(posterior, rays);
  posterior.touch.assign(posterior.occupied.size(), 0.5f);
  posterior.centre = posterior.touch;
  tbb::parallel_for(std::size_t{0}, posterior.occupied.size(), [&](std::size_t v) {
    if (!posterior.informed[v]) return;
    const ReadOutFeatures::Vector x = features.of(static_cast<std::uint32_t>(v));
    const auto logistic = [&](const ReadOutFeatures::Vector& w) {
      return static_cast<float>(probability(std::inner_product(x.begin(), x.end(), w.begin(), 0.0)));
    };
    posterior.touch[v] = logistic(weights.touch);
    posterior.centre[v] = logistic(weights.centre);
  });
}

}  // namespace nextview
