#include "app/commands/resumed_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "core/file/counted.hpp"
#include "core/file/read_file.hpp"
#include "core/journal/capture_file.hpp"
#include "core/results/manifest.hpp"
#include "core/session/scan_loop.hpp"

namespace nextview {

namespace {

/// What says which scans are taken, as long as none was rejected for it. The mode says where they lie.
bool is_registration_limit(std::string_view key) {
  return key.starts_with("registration.max_") || key == "registration.beyond_limits";
}

/// Whether its results are there, and are not those of one that was stopped.
bool has_ended(const std::filesystem::path& folder) {
  if (!is_there(folder / "metrics.json")) return false;
  const auto metrics = nlohmann::json::parse(read_file(folder / "metrics.json"), nullptr, false);
  return metrics.is_object() && metrics.contains("finished") && metrics["finished"] != "";
}

}  // namespace

bool adopt_changes(const ConfigurationOptions& options, SavedSession& saved) {
  Configuration& configuration = saved.configuration;
  Configuration wanted = configuration;
  options.apply_to(wanted);
  auto now = settings(configuration), then = settings(wanted);
  bool has_changed = false;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].text() == then[i].text()) continue;
    has_changed = true;
    if (!now[i].key.starts_with("termination.") && !is_registration_limit(now[i].key))
      throw std::invalid_argument(wanted.as_given(fmt::format(
          "{}: --resume goes on with the settings that the scan was begun with; termination.* and the limits of "
          "registration alone may change",
          now[i].key)));
  }
  // With fewer, config.toml would no longer repeat the scan.
  const auto taken = saved.journal ? int(saved.journal->line().size()) : 0;
  if (wanted.termination.views != configuration.termination.views && wanted.termination.views < taken)
    throw std::invalid_argument(
        wanted.as_given(fmt::format("termination.views: {} has {} already; give more to go on", saved.folder.string(),
                                    counted(std::size_t(taken), "view"))));
  configuration.termination = wanted.termination;
  configuration.registration = wanted.registration;
  return has_changed;
}

void require_no_earlier_end(const Session& session, const SavedSession& saved) {
  const auto& records = session.state().records;
  ScanState earlier = session.state();
  for (std::size_t views = 1; views < records.size(); ++views) {
    earlier.records.assign(records.begin(), records.begin() + std::ptrdiff_t(views));
    const std::string reason = termination(session.configuration().termination, earlier);
    if (reason.empty()) continue;
    throw std::invalid_argument(fmt::format(
        "{}: by these settings it would have ended after {} of its {} views: {}; give others of termination.*",
        saved.folder.string(), views, records.size(), reason));
  }
}

void require_captures_of_results(const SavedSession& saved) {
  if (!saved.journal || !has_ended(saved.folder)) return;
  std::vector<std::string> lost;
  for (const JournalStep& step : saved.journal->line()) {
    try {
      read_capture(step, saved.folder);
    } catch (const CaptureLost& error) {
      lost.emplace_back(error.what());
    }
  }
  if (lost.empty()) return;
  throw std::runtime_error(fmt::format(
      "{}{}; the scan had ended, and its results stay as they are. To go on without it, let the scan end later, by "
      "--views or another of termination.*",
      lost.front(), lost.size() == 1 ? "" : fmt::format(", and {} more are lost", lost.size() - 1)));
}

bool has_files(const std::filesystem::path& folder, bool pictures, bool surfaces) {
  const auto manifest = read_manifest(folder);
  const auto has = [&](const char* name) { return std::ranges::find(manifest->files, name) != manifest->files.end(); };
  return manifest && has("metrics.json") && (!pictures || has("step_01.png")) && (!surfaces || has("surfaces.json")) &&
         std::ranges::all_of(manifest->files, [&](const std::string& name) { return is_there(folder / name); });
}

}  // namespace nextview
