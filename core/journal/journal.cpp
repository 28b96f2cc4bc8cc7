#include "core/journal/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/make_folder.hpp"
#include "core/file/read_file.hpp"
#include "core/file/unchanged.hpp"
#include "core/journal/capture_file.hpp"
#include "core/journal/journal_records.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

bool leads_through(const Journal& journal, const Branch& branch) {
  if (journal.at == 0) return true;
  return std::ranges::any_of(journal.line(branch.tip), [&](const auto& step) { return step.number == journal.at; });
}

/// Where records are lost it may stand on none.
void stand_on_a_branch(Journal& journal) {
  Branches& branches = journal.branches;
  if (leads_through(journal, branches.current())) return;
  const auto other =
      std::ranges::find_if(branches.all, [&](const Branch& branch) { return leads_through(journal, branch); });
  if (other == branches.all.end())
    branches.begin(branches.free_name(), journal.at);
  else
    branches.on = static_cast<std::size_t>(other - branches.all.begin());
}

Journal journal_of(JournalText text, const fs::path& file) {
  Journal journal;
  journal.bytes = text.whole;
  journal.damage = std::move(text.damage);
  bool begun = false;
  for (const std::string& record : text.records) {
    try {
      begun |= read_record(record, journal);
    } catch (const NewerJournal& error) {
      throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
    } catch (const std::exception&) {  // JSON's own messages quote what is there
      journal.damage.emplace_back("a record of the journal says nothing that is known, and is left out");
    }
  }
  if (!begun)
    throw std::runtime_error(fmt::format("{}: is no journal of a session, or its beginning is lost", file.string()));
  stand_on_a_branch(journal);
  return journal;
}

}  // namespace

std::vector<JournalStep> Journal::line(std::uint32_t tip) const {
  std::vector<JournalStep> line;
  std::uint32_t number = tip;
  while (number > 0) {
    auto step = steps.upper_bound(number);  // where it is lost: the one before
    if (step == steps.begin()) break;
    --step;
    line.push_back(step->second);
    number = std::min(step->second.after, step->first - 1);
  }
  std::ranges::reverse(line);
  return line;
}

bool has_journal(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / journal_name, ignored);  // a folder may be called that for other reasons
}

Journal read_journal(const fs::path& folder) {
  const fs::path file = folder / journal_name;
  return journal_of(read_journal_file(file), file);
}

Capture read_capture(const JournalStep& step, const fs::path& folder) {
  const fs::path file = folder / scans_name / step.scan;
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::not_found) throw CaptureLost(fmt::format("{}: is gone", file.string()));
  if (type != fs::file_type::regular && type != fs::file_type::none)
    throw CaptureLost(fmt::format("{}: is no regular file", file.string()));
  const std::string bytes = read_file(file);
  if (!(hash_of(bytes) == step.hash))
    throw CaptureLost(fmt::format("{}: is not what was captured: it is damaged, or was changed", file.string()));
  Capture capture{captured_of(bytes, file, step.camera), step.T_world_camera, step.max_range};
  if (std::holds_alternative<DepthImage>(capture.measured) && !(step.camera.fx > 0 && step.camera.fy > 0))
    throw CaptureLost(fmt::format("{}: the journal does not say by what camera", file.string()));
  return capture;
}

void require_same_input(const Journal& journal, const fs::path& folder) {
  const JournalInput& input = journal.input;  // an absolute path stays as it is
  if (input.hash) require_unchanged(folder / input.path, *input.hash, folder);
}

JournalWriter::JournalWriter(fs::path folder, JournalFile file) : folder_(std::move(folder)), file_(std::move(file)) {
  make_folder(folder_ / scans_name);
}

JournalWriter JournalWriter::begin(const fs::path& folder, const JournalInput& input, const std::string& settings) {
  JournalFile file = JournalFile::begin(folder / journal_name);
  try {
    JournalWriter writer(folder, std::move(file));
    writer.file_.append(beginning_record(input, settings));
    keep_names(folder);
    keep_names(folder / "..");  // the folder may be new, too
    return writer;
  } catch (...) {  // of a full disk, most likely: empty, it would be taken for a journal that lost its beginning
    std::error_code ignored;
    fs::remove(folder / journal_name, ignored);
    throw;
  }
}

JournalWriter JournalWriter::go_on(const fs::path& folder, Journal& journal) {
  const fs::path file = folder / journal_name;
  JournalText text;
  JournalWriter writer(folder, JournalFile::go_on(file, text, journal.bytes));
  if (text.whole != journal.bytes) journal = journal_of(std::move(text), file);
  return writer;
}

void JournalWriter::add(JournalStep& step, const Capture& capture) {
  step.scan = write_capture(capture, step.number, folder_ / scans_name);
  step.hash = file_hash(folder_ / scans_name / step.scan);
  file_.append(step_record(step));
}

void JournalWriter::keep_settings(const std::string& text) { file_.append(settings_record(text)); }

void JournalWriter::stand_at(std::uint32_t number) { file_.append(position_record(number)); }

void JournalWriter::keep_branches(const Branches& branches) { file_.append(branches_record(branches)); }

void JournalWriter::keep_outcome(std::uint32_t number, const std::map<std::string, double>& outcome) {
  file_.append(outcome_record(number, outcome));
}

void JournalWriter::keep_reach(std::uint32_t number, const std::vector<Reach>& reach) {
  file_.append(reach_record(number, reach));
}

void JournalWriter::close() { file_.append(closing_record()); }

}  // namespace nextview
