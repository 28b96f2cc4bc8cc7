#pragma once
#include <vector>

#include "core/gibbs/read_out.hpp"
#include "tests/benchmarks/evidence_cases.hpp"

namespace nextview {

/// How the posterior of a case is sampled.
PosteriorSamplerConfig sampler_of(const EvidenceCase& c);
/// The conventional map's probabilities, which the chains start from.
std::vector<float> octomap_of(const EvidenceCase& c);
/// The rays that the sampler sees, by voxel.
ReadOutRays rays_of(const EvidenceCase& c);

}  // namespace nextview
