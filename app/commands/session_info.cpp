#include "app/commands/session_info.hpp"

#include <fmt/format.h>

#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/journal/journal.hpp"
#include "core/session/step_outcome.hpp"
#include "core/setting/entropy_text.hpp"

namespace nextview {
namespace {

/// What came of the last view, if it is known.
std::string outcome_text(const JournalStep& last) {
  const StepRecord record = record_with(last.outcome);
  std::string text;
  if (record.coverage_visible > 0) text += fmt::format(", {:.1f} % of visible surface", 100 * record.coverage_visible);
  if (record.entropy > 0) text += ", unmeasured entropy " + entropy_text(record.entropy);
  return text;
}

}  // namespace

std::string session_info(const std::filesystem::path& folder) {
  const Journal journal = read_journal(folder);
  std::string text = fmt::format("  a session of {}: {}", printable(journal.input.path),
                                 journal.closed ? "closed" : "nobody closed it; --resume goes on with it");
  for (const Branch& branch : journal.branches.all) {
    const auto line = journal.line(branch.tip);
    const bool is_here = branch == journal.branches.current();
    text += fmt::format("\n  branch '{}': {}{}", printable(branch.name), counted(line.size(), "view"),
                        line.empty() ? "" : outcome_text(line.back()));
    if (is_here) text += fmt::format("; it stands at view {} of them", journal.line().size());
  }
  for (const std::string& damage : journal.damage) text += "\n  " + printable(damage);
  return text;
}

}  // namespace nextview
