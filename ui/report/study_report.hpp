#pragma once
#include <filesystem>
#include <string>

#include "core/study/summary_table.hpp"

namespace nextview {

/// A study as one HTML file: what it compared, its charts, tables of means, spreads and paired comparisons, each number
/// with the runs and the hash of the keys it came from and how to compute it once more, the objects by their check
/// sums, seconds, and what failed. The same study gives the same bytes.
/// @throws std::runtime_error naming a file of the folder that is missing or no study's
std::string study_report(const std::filesystem::path& folder, const SummaryTable& table);

/// A table a part: what is best under each sensor and number of views.
std::string report_overview(const Study& study, const SummaryTable& table);
/// All tables: a section a block, in it a table a sensor and number of views.
std::string report_tables(const Study& study, const SummaryTable& table);

}  // namespace nextview
