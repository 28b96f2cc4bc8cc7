#pragma once
#include <filesystem>
#include <span>
#include <stop_token>
#include <vector>

#include "app/commands/progress.hpp"
#include "ui/report/scan_figures.hpp"

namespace nextview {

/// Saved sessions as figures need them: their views are taken again from what was captured.
/// @throws as read_session; std::invalid_argument for one without a view; Stopped
std::vector<ReportScan> report_scans(std::span<const std::string> folders, const ProgressLine& progress,
                                     const std::stop_token& stop);
/// Scans that are made for figures where no session is given: 20 views of two parts that come with the program, with a
/// coarse camera, for seconds. @throws Stopped
std::vector<ReportScan> made_scans(const ProgressLine& progress, const std::stop_token& stop);

}  // namespace nextview
