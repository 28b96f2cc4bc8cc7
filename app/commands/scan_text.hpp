#pragma once
#include <filesystem>
#include <string>

#include "core/session/session.hpp"

namespace nextview {

// What `scan` prints.

/// What is scanned and how, and the head of the table.
void print_head(const Session& session);
/// A row of the table.
void print_step(const Session& session, const StepRecord& record);
/// Why it ended, and how well. `failed`: it stopped for a reason that is said after it.
void print_end(const Session& session, bool failed);
/// What was written where, and what to do next.
void print_files(const Session& session, const std::filesystem::path& out, bool pictures, const std::string& surfaces);

}  // namespace nextview
