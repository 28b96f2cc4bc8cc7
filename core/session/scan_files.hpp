#pragma once
#include <filesystem>

#include "core/session/session.hpp"

namespace nextview {

/// Makes the folder and sees that it can be written to. @throws std::runtime_error naming it and the reason.
void prepare_output_folder(const std::filesystem::path& folder);

/// Writes what a scan found: config.toml, steps.csv (a row a view), scores.csv (every candidate at every step),
/// views.csv (the poses taken), map.ot, map.bt, cloud.ply, metrics.json, and timings.csv (seconds per stage: the only
/// file that differs between two runs). With gain gibbs also posterior.ot and refinement.csv.
/// @throws std::runtime_error naming the file and the reason.
void write_scan(const Session& session, const std::filesystem::path& folder);

}  // namespace nextview
