#include "core/gain/gain.hpp"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

namespace nextview {
namespace {

bool is_unknown(const Voxel& v) { return v.voxel_class == VoxelClass::unknown; }  // unmeasured ones are, at p = 0.5
bool is_occupied(const Voxel& v) { return v.voxel_class == VoxelClass::occupied; }
bool is_behind_surface(const Voxel& v) { return !v.measured && v.occlusion_distance > 0; }

/// Most gains are their first sum.
GainValue plain_sum(const GainSums& s) { return {s.sum[0], {1.0, 0.0, 0.0}}; }

/// Below, pi_i is the visibility of voxel v_i on a ray, H its entropy [nats], v_N the voxel that ends the ray; sums are
/// over the voxels of all rays of a view. Each gain: `ray` calls add(voxel's place on the ray, which sum, how much).
/// Of gains that are what each voxel is worth, whatever else is on the ray: rays in lanes add these up (ray_lanes.hpp).
template <class G, bool weighs>
struct SumOfVoxels {
  static constexpr bool weighs_visibility = weighs;
  template <class Add>
  static void ray(const Ray& ray, GainSums&, Add add) {
    for (std::size_t i = 0; i < ray.voxels.size(); ++i) {
      const double worth = G::worth(ray.voxels[i], ray.occlusion_reach);
      add(i, 0, weighs ? ray.visibility[i] * worth : worth);
    }
  }
  static constexpr auto value = plain_sum;
};

/// Occlusion aware (Isler et al. 2016): sum of pi_i H(p_i).
struct OcclusionAware : SumOfVoxels<OcclusionAware, true> {
  static double worth(const Voxel& v, double) { return v.entropy; }
};

/// Unobserved voxel (Isler et al. 2016): sum of pi_i H(p_i) over unknown voxels.
struct UnobservedVoxel : SumOfVoxels<UnobservedVoxel, true> {
  static double worth(const Voxel& v, double) { return is_unknown(v) ? v.entropy : 0.0; }
};

/// Rear side voxel (Isler et al. 2016): the number of occupied v_i whose v_(i-1) is unknown.
struct RearSideVoxel {
  template <class Add>
  static void ray(const Ray& ray, GainSums&, Add add) {
    for (std::size_t i = 1; i < ray.voxels.size(); ++i)
      if (is_occupied(ray.voxels[i]) && is_unknown(ray.voxels[i - 1])) add(i, 0, 1.0);
  }
  static constexpr auto value = plain_sum;
};

/// Rear side entropy (Isler et al. 2016): sum of pi_i H(p_i) over an occupied v_N and the unknown run before it.
struct RearSideEntropy {
  template <class Add>
  static void ray(const Ray& ray, GainSums&, Add add) {
    if (ray.voxels.empty() || !is_occupied(ray.voxels.back())) return;
    std::size_t first = ray.voxels.size() - 1;
    while (first > 0 && is_unknown(ray.voxels[first - 1])) --first;
    for (std::size_t i = first; i < ray.voxels.size(); ++i) add(i, 0, ray.visibility[i] * ray.voxels[i].entropy);
  }
  static constexpr auto value = plain_sum;
};

/// Proximity count (Isler et al. 2016): sum of d_max - d(v_i) over unmeasured v_i at d behind a surface.
struct ProximityCount : SumOfVoxels<ProximityCount, false> {
  static double worth(const Voxel& v, double occlusion_reach) {
    return is_behind_surface(v) ? occlusion_reach - v.occlusion_distance : 0.0;
  }
};

/// Area factor (Vasquez-Gomez et al. 2014): f(n_o/n; 0.2) + f(n_p/n; 0.8), of n ray ends n_o occupied, n_p occluded.
struct AreaFactor {
  enum End { occupied, occluded, unknown };

  template <class Add>
  static void ray(const Ray& ray, GainSums& sums, Add add) {
    bool previous_free = true;
    for (std::size_t i = 0; i < ray.voxels.size(); ++i) {
      const RayVoxel& v = ray.voxels[i];
      if (is_behind_surface(v)) return add(i, occluded, 1.0);
      if (v.measured && is_occupied(v)) {
        if (v.has_node) sums.node_seen = true;
        // The reference counts an occupied end only behind what it takes for free.
        if (ray.semantics == Semantics::published || previous_free) add(i, occupied, 1.0);
        return;
      }
      // `node_seen` outlives the ray: a leak of the reference code, kept for its numbers.
      previous_free = v.has_node ? !is_unknown(v) : !sums.node_seen;
      if (v.has_node) sums.node_seen = true;
    }
    // A ray past the region ends in the void: it counts, but there is no voxel to say so of.
    if (ray.voxels.empty())
      sums.sum[unknown] += 1.0;
    else
      add(ray.voxels.size() - 1, unknown, 1.0);
  }

  /// -2 x^3 / a^3 + 3 x^2 / a^2 up to a: rises from 0 to 1 at x = a and falls back to 0 at x = 1.
  static double f(double x, double a) {
    if (x <= a) return -2.0 * x * x * x / (a * a * a) + 3.0 * x * x / (a * a);
    const double b = (a - 1.0) * (a - 1.0) * (a - 1.0);
    // Term by term, as the reference code has it: a share of 1 gives 2.8e-14 there, not 0.
    return -2.0 / b * x * x * x + 3.0 * (a + 1.0) / b * x * x - 6.0 * a / b * x + (3.0 * a - 1.0) / b;
  }

  static GainValue value(const GainSums& s) {
    const double n = s.sum[occupied] + s.sum[occluded] + s.sum[unknown];
    if (n == 0.0) return {};
    const double of_occupied = f(s.sum[occupied] / n, 0.2), of_occluded = f(s.sum[occluded] / n, 0.8);
    const auto each = [](double value, double count) { return count > 0.0 ? value / count : 0.0; };
    return {of_occupied + of_occluded, {each(of_occupied, s.sum[occupied]), each(of_occluded, s.sum[occluded]), 0.0}};
  }
};

/// Average entropy (Kriegel et al. 2015): sum of H(p_i) over sum of N + 1, of the rays that end on the object.
struct AverageEntropy {
  template <class Add>
  static void ray(const Ray& ray, GainSums& sums, Add add) {
    if (ray.voxels.empty() || !is_occupied(ray.voxels.back())) return;
    for (std::size_t i = 0; i < ray.voxels.size(); ++i) add(i, 0, ray.voxels[i].entropy);
    sums.sum[1] += static_cast<double>(ray.voxels.size());
  }
  static GainValue value(const GainSums& s) {
    if (s.sum[1] == 0.0) return {};
    return {s.sum[0] / s.sum[1], {1.0 / s.sum[1], 0.0, 0.0}};
  }
};

/// Gibbs (Eqs. 10-11): sum of H(p_i), p the posterior: every voxel counts in full, as the ray ends where the posterior
/// says 'occupied'.
struct Gibbs : SumOfVoxels<Gibbs, false> {
  static double worth(const Voxel& v, double) { return v.entropy; }
};

template <class G>
constexpr auto worth_in() -> double (*)(const Voxel&, double) {
  if constexpr (requires { G::weighs_visibility; }) return G::worth;
  return nullptr;
}
template <class G>
constexpr bool weighs_visibility() {
  if constexpr (requires { G::weighs_visibility; }) return G::weighs_visibility;
  return false;
}

template <class G>
constexpr Gain make(std::string_view name, std::string_view unit, std::string_view summary,
                    bool needs_occlusion = false, bool needs_posterior = false) {
  return {name,
          unit,
          summary,
          needs_occlusion,
          needs_posterior,
          worth_in<G>(),
          weighs_visibility<G>(),
          [](const Ray& ray, GainSums& sums) {
            G::ray(ray, sums, [&sums](std::size_t, int k, double amount) { sums.sum[k] += amount; });
          },
          [](const GainSums& sums) { return G::value(sums); },
          [](const Ray& ray, GainSums& sums, const std::array<double, 3>& worth, std::span<double> contribution) {
            G::ray(ray, sums, [&](std::size_t i, int k, double amount) { contribution[i] += worth[k] * amount; });
          }};
}

constexpr std::array all_gains = {
    make<OcclusionAware>("occlusion-aware", "nats",
                         "entropy along each ray, weighted by how likely the ray gets there"),
    make<UnobservedVoxel>("unobserved-voxel", "nats", "the same, over unknown voxels only"),
    make<RearSideVoxel>("rear-side-voxel", "voxels", "occupied voxels met from behind: right after an unknown one"),
    make<RearSideEntropy>("rear-side-entropy", "nats", "entropy of the unknown stretch in front of an occupied end"),
    make<ProximityCount>("proximity-count", "voxels", "unmeasured voxels behind a surface, the nearer the more", true),
    make<AreaFactor>("area-factor", "", "nearness of the shares of occupied and occluded ends to 0.2 and 0.8", true),
    make<AverageEntropy>("average-entropy", "nats/voxel", "mean entropy of the voxels on rays that end on the object"),
    make<Gibbs>("gibbs", "nats", "entropy of the Gibbs map along each ray, up to its first occupied voxel", false,
                true),
};

constexpr std::array<WeightedGain, 2> prerelease = {{{"average-entropy", 30.0}, {"rear-side-entropy", 1.0}}};

double total(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

std::span<const Gain> gains() { return all_gains; }

const Gain& gain(std::string_view name) {
  std::string known;
  for (const Gain& g : all_gains) {
    if (g.name == name) return g;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", g.name);
  }
  throw std::invalid_argument(fmt::format("there is no gain '{}'; there are {}", name, known));
}

std::span<const WeightedGain> prerelease_weights() { return prerelease; }

std::vector<double> combine(std::span<const double> weights, std::span<const std::vector<double>> values,
                            Semantics semantics) {
  std::vector<double> combined(values.empty() ? 0 : values.front().size(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double sum = semantics == Semantics::published ? total(values[k]) : 1.0;
    if (sum == 0.0) continue;
    for (std::size_t v = 0; v < combined.size(); ++v) combined[v] += weights[k] * values[k][v] / sum;
  }
  if (semantics == Semantics::reference)
    if (const double sum = total(combined); sum != 0.0)
      for (double& c : combined) c /= sum;
  return combined;
}

}  // namespace nextview
