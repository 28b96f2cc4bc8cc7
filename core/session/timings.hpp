#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/session/session.hpp"

namespace nextview {

inline constexpr const char* timings_name = "timings.csv";

/// Seconds of each stage of each step, a row a step: all of a scan that differs between two runs.
std::string timings_csv(const Session& session);
/// What it said, as far as it can be read; empty without. Never throws.
std::vector<StageSeconds> read_timings(const std::filesystem::path& folder);

}  // namespace nextview
