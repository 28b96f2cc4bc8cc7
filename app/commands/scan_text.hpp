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
/// Why it ended, and how well; `failure`: what ended it before it was done, or empty.
void print_end(const Session& session, const std::string& failure);
/// What was written where, and what to do next.
void print_files(const Session& session, const std::filesystem::path& out, bool pictures, const std::string& surfaces);

}  // namespace nextview
