#pragma once
#include <filesystem>
#include <stop_token>

#include "app/commands/options.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "core/offline/refinement.hpp"

namespace nextview {

/// How range scans are read, which do not tell it themselves; see read_range_scan_folder.
struct RangeScanOptions {
  double resolution = 0.0, stand_off = default_stand_off;  // [m]

  /// Adds --voxel and --stand-off.
  void add_to(CLI::App& app);
};

/// What finished scans say: a folder that `scan` wrote (what `options` say overrides its configuration), a folder of
/// range scans, or a scene file.
/// @throws std::runtime_error, std::invalid_argument naming the file and the reason.
RefinementJob recorded_job(const std::filesystem::path& input, const ConfigurationOptions& options,
                           const RangeScanOptions& range_scans, const Progress& progress, std::stop_token stop);

}  // namespace nextview
