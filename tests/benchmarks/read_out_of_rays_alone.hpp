#pragma once
#include "core/gibbs/read_out.hpp"

namespace nextview {

/// The control: a read-out of the same form and fit that sees how many rays crossed a voxel and those around it and
/// how many ended there, and no posterior. What the Gibbs map is better by, the posterior adds.
const ReadOutWeights& read_out_of_rays_alone();

}  // namespace nextview
