#pragma once
#include "core/results/output_folder.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// Writes what a scan found: config.toml, steps.csv (a row per view), scores.csv (every candidate at every step),
/// views.csv (the poses taken), map.ot, map.bt, cloud.ply, metrics.json, and timings.csv (seconds per stage: the only
/// file that differs between two runs). With gain gibbs also posterior.ot and refinement.csv.
/// @pre out.begin() was called. @throws std::runtime_error naming the file and the reason.
void write_scan(const Session& session, OutputFolder& out);

}  // namespace nextview
