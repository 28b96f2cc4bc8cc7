#include "tests/unit/gain/gain_twins.hpp"

#include <cmath>

namespace nextview::gain_twins {
namespace {

bool unknown(const RayVoxel& v) { return !v.measured || (v.probability >= 0.2f && v.probability <= 0.8f); }
bool occupied(const RayVoxel& v) { return v.measured && v.probability > 0.8f; }
double h(const RayVoxel& v) {
  const double p = v.probability;
  return -p * std::log(p) - (1 - p) * std::log(1 - p);
}

/// pi_i as a product over all voxels before i.
double visibility(const VoxelsOfRay& ray, std::size_t i, Semantics semantics) {
  double product = 1.0;
  for (std::size_t k = 0; k < i; ++k)
    product *= semantics == Semantics::published ? 1.0 - ray[k].probability : double(ray[k].probability);
  return product;
}

double rear_side_entropy(const VoxelsOfRay& ray, Semantics semantics) {
  if (ray.empty() || !occupied(ray.back())) return 0.0;
  const std::size_t last = ray.size() - 1;
  double sum = visibility(ray, last, semantics) * h(ray[last]);
  for (std::size_t i = last; i-- > 0 && unknown(ray[i]);) sum += visibility(ray, i, semantics) * h(ray[i]);
  return sum;
}

double f(double x, double alpha) {
  if (x <= alpha) return -2 * std::pow(x / alpha, 3) + 3 * std::pow(x / alpha, 2);
  return (-2 * x * x * x + 3 * (alpha + 1) * x * x - 6 * alpha * x + 3 * alpha - 1) / std::pow(alpha - 1, 3);
}

/// How the reference code judges rays: `seen` outlives them.
enum class End { occupied, occluded, unknown, uncounted };
End end_of_reference_ray(const VoxelsOfRay& ray, bool& seen) {
  bool previous_free = true;
  for (const RayVoxel& v : ray) {
    if (!v.measured && v.occlusion_distance > 0) return End::occluded;
    if (v.has_node) seen = true;
    if (occupied(v)) return previous_free ? End::occupied : End::uncounted;
    previous_free = v.has_node ? !unknown(v) : !seen;
  }
  return End::unknown;
}

End end_of_published_ray(const VoxelsOfRay& ray) {
  for (const RayVoxel& v : ray) {
    if (!v.measured && v.occlusion_distance > 0) return End::occluded;
    if (occupied(v)) return End::occupied;
  }
  return End::unknown;
}

double area_factor(std::span<const VoxelsOfRay> rays, Semantics semantics) {
  bool seen = false;
  double n_o = 0, n_p = 0, n = 0;
  for (const VoxelsOfRay& ray : rays) {
    const End end = semantics == Semantics::reference ? end_of_reference_ray(ray, seen) : end_of_published_ray(ray);
    n_o += end == End::occupied;
    n_p += end == End::occluded;
    n += end != End::uncounted;
  }
  return n == 0 ? 0.0 : f(n_o / n, 0.2) + f(n_p / n, 0.8);
}

}  // namespace

std::map<std::string, double> values(std::span<const VoxelsOfRay> rays, Semantics semantics, double d_max) {
  std::map<std::string, double> sum = {{"occlusion-aware", 0},   {"unobserved-voxel", 0}, {"rear-side-voxel", 0},
                                       {"rear-side-entropy", 0}, {"proximity-count", 0},  {"gibbs", 0}};
  double entropy_to_surfaces = 0, voxels_to_surfaces = 0;
  for (const VoxelsOfRay& ray : rays) {
    for (std::size_t i = 0; i < ray.size(); ++i) {
      const double expected = visibility(ray, i, semantics) * h(ray[i]);
      sum["occlusion-aware"] += expected;
      sum["gibbs"] += h(ray[i]);
      sum["unobserved-voxel"] += unknown(ray[i]) ? expected : 0.0;
      sum["rear-side-voxel"] += i > 0 && occupied(ray[i]) && unknown(ray[i - 1]);
      if (!ray[i].measured && ray[i].occlusion_distance > 0)
        sum["proximity-count"] += d_max - ray[i].occlusion_distance;
      if (occupied(ray.back())) entropy_to_surfaces += h(ray[i]), ++voxels_to_surfaces;
    }
    sum["rear-side-entropy"] += rear_side_entropy(ray, semantics);
  }
  sum["average-entropy"] = voxels_to_surfaces > 0 ? entropy_to_surfaces / voxels_to_surfaces : 0.0;
  sum["area-factor"] = area_factor(rays, semantics);
  return sum;
}

}  // namespace nextview::gain_twins
