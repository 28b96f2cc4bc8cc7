#pragma once
#include "core/offline/refinement.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {

/// Writes posterior.ot, posterior.bt and conventional.ot, scores.csv (each candidate before and after), trace.csv (each
/// sweep of each chain), metrics.json (diagnostics, and scores where there is a truth), config.toml; timings.csv is the
/// only one that differs between two runs. @pre out.begin() was called. @throws std::runtime_error naming the file and
/// the reason.
void write_refinement(const RefinementJob& job, const Refinement& refinement, OutputFolder& out);

}  // namespace nextview
