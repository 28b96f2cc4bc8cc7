#include "app/commands/recorded_input.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/config/input_files.hpp"
#include "core/file/gzip_file.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/results/manifest.hpp"
#include "core/session/saved_session.hpp"
#include "core/setting/mistyped_path.hpp"

namespace nextview {

namespace fs = std::filesystem;

void RangeScanOptions::add_to(CLI::App& app) {
  app.add_option("--voxel", resolution, "range scans: voxel edge [m]; 0: a hundredth of their extent")
      ->capture_default_str()
      ->transform(within(range_scan_voxel_bounds, "m"));
  app.add_option("--stand-off", stand_off, "range scans: the scanner's distance, which they do not tell [m]")
      ->capture_default_str()
      ->transform(within(stand_off_bounds, "m"));
}

RefinementJob recorded_job(const fs::path& input, const ConfigurationOptions& options,
                           const RangeScanOptions& range_scans, const Progress& progress, std::stop_token stop) {
  if (!is_there(input))
    throw std::runtime_error(
        fmt::format("{}: there is no such file or folder{}", input.string(), did_you_mean_path(input)));
  const auto warn = [&](const std::string& text) {
    fmt::print(stderr, "{}\n", printable(fmt::format("{}: {}", input.string(), text)));
  };
  const bool is_finished = is_there(input / "config.toml") && is_session(input);
  if (range_scans.resolution > 0.0 && (is_finished || !fs::is_directory(input)))
    warn("--voxel is for range scans: this keeps the voxels that it has");
  if (is_finished)
    return refinement_job(
        input, [&](Configuration& c) { options.apply_to(c); }, progress, stop);
  if (const auto manifest = fs::is_directory(input) ? read_manifest(input) : std::nullopt)
    throw std::runtime_error(
        fmt::format("{}: holds no finished scan: it is what {} left, or was ended before its views were written",
                    input.string(), manifest->command));
  const RecordedScene scene = fs::is_directory(input)
                                  ? read_range_scan_folder(input, range_scans.stand_off, range_scans.resolution, warn)
                                  : read_recorded_scene(input);
  const Configuration configuration = options.configuration();
  try {
    RefinementJob job = refinement_job(scene, configuration.gibbs, configuration.seed, warn);
    job.name = without_gz(fs::absolute(input).lexically_normal()).stem().string();
    job.configuration = configuration;
    job.inputs = recorded_files(input);
    for (const fs::path& file : configuration.read_from) job.inputs.push_back({file, "read as configuration"});
    return job;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", input.string(), error.what()));
  }
}

}  // namespace nextview
