#pragma once
#include "core/journal/journal.hpp"

namespace nextview {

// The records of a journal: JSON objects in a line, told apart by `record`.

/// It was written by a version that this one does not know.
struct NewerJournal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// With the settings: there is no journal without.
std::string beginning_record(const JournalInput& input, const std::string& settings);
std::string settings_record(const std::string& text);
std::string step_record(const JournalStep& step);
std::string position_record(std::uint32_t number);
std::string branches_record(const Branches& branches);
std::string outcome_record(std::uint32_t number, const std::map<std::string, double>& outcome);
std::string reach_record(std::uint32_t number, const std::vector<Reach>& reach);
std::string closing_record();

/// Adds what a record says. True if it is the one that a journal begins with.
/// @throws NewerJournal; std::exception if it says nothing that is known or possible
bool read_record(const std::string& record, Journal& journal);

}  // namespace nextview
