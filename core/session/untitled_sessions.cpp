#include "core/session/untitled_sessions.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "core/file/counted.hpp"
#include "core/journal/journal.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/recent_files.hpp"
#include "core/session/step_outcome.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kept_sessions = 10;
constexpr std::size_t time_length = 19;  // of "2026-01-31 23.59.59"

/// The newest first: their names begin with the time.
std::vector<fs::path> untitled_sessions(const fs::path& state) {
  std::vector<fs::path> sessions;
  std::error_code error;
  for (fs::directory_iterator entry(state, error), end; !error && entry != end; entry.increment(error))
    if (has_journal(entry->path())) sessions.push_back(entry->path());
  std::ranges::sort(sessions, std::greater<>());
  return sessions;
}

/// Of now, for a name, or a second after the newest: where the clock was set back, or summer time has ended, what is
/// made now would go as the oldest.
std::string time_after(const std::vector<fs::path>& sessions) {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  std::string text = fmt::format("{:%Y-%m-%d %H.%M.%S}", fmt::localtime(now));
  const std::string newest = sessions.empty() ? "" : sessions.front().filename().string().substr(0, time_length);
  std::tm time{};
  if (text > newest || !::strptime(newest.c_str(), "%Y-%m-%d %H.%M.%S", &time)) return text;
  ++time.tm_sec;
  ::timegm(&time);  // whatever is beyond 59
  return fmt::format("{:%Y-%m-%d %H.%M.%S}", time);
}

/// What can be a file's name anywhere.
std::string plain(std::string name) {
  for (char& c : name)
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ') c = '_';
  return name.substr(0, 40);
}

/// Nothing but what its own list names, and nothing that is in use.
void remove_session(const fs::path& folder) {
  try {
    Journal ignored;
    { const JournalWriter lock = JournalWriter::go_on(folder, ignored); }
    OutputFolder(folder, {}).remove();
  } catch (const std::runtime_error&) {  // it stays
  }
}

/// For people: without the time that names of untitled ones begin with.
std::string name_of(const fs::path& state, const fs::path& folder) {
  const std::string name = folder.filename().string();
  const bool has_time = folder.parent_path() == state && name.size() > time_length;
  return has_time ? name.substr(time_length + 1) : name;
}

EarlierSession earlier_session_of(const fs::path& state, const fs::path& folder, const Journal& journal) {
  EarlierSession session{folder, name_of(state, folder)};
  const std::vector<JournalStep> line = journal.line();
  session.views = line.size();
  const auto time = fs::last_write_time(folder / journal_name);
  session.time = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(time));
  if (line.empty()) return session;
  const StepRecord last = record_with(line.back().outcome);
  const double coverage = last.coverage_recorded.value_or(last.coverage_visible);
  if (coverage > 0.0) session.coverage = coverage;  // 0 without a truth, too
  return session;
}

/// "today 14:05", "yesterday 9:05", "2026-01-31 14:05".
std::string day_and_time(std::time_t time, std::time_t now) {
  const std::tm then = fmt::localtime(time);
  const std::string day = fmt::format("{:%Y-%m-%d}", then);
  std::tm before = fmt::localtime(now);
  const bool today = day == fmt::format("{:%Y-%m-%d}", before);
  --before.tm_mday;
  before.tm_isdst = -1;
  std::mktime(&before);  // whatever is before the first
  const bool yesterday = day == fmt::format("{:%Y-%m-%d}", before);
  return fmt::format("{} {:%H:%M}", today ? "today" : yesterday ? "yesterday" : day, then);
}

/// The first of these that has views, is wanted, and that no program writes.
template <class Wanted>
std::optional<EarlierSession> first_session(const fs::path& state, const std::vector<fs::path>& folders,
                                            const Wanted& wanted) {
  for (const fs::path& folder : folders) {
    try {
      Journal journal;
      { const JournalWriter lock = JournalWriter::go_on(folder, journal); }
      const EarlierSession session = earlier_session_of(state, folder, journal);
      if (session.views > 0 && wanted(journal)) return session;
    } catch (const std::runtime_error&) {  // in use, or damaged
    }
  }
  return std::nullopt;
}

}  // namespace

std::string EarlierSession::summary(std::time_t now) const {
  const std::string covered = coverage ? fmt::format(", {:.1f} %", 100 * *coverage) : "";
  return fmt::format("{}{}, {}", counted(views, "view"), covered, day_and_time(time, now));
}

fs::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && fs::path(state).is_absolute())
    return fs::path(state) / "nextview";
  const char* home = std::getenv("HOME");
  return home && fs::path(home).is_absolute() ? fs::path(home) / ".local/state/nextview" : fs::path();
}

fs::path folder_of_kept(const fs::path& name) {
  if (name.empty() || name.has_parent_path() || is_there(name)) return name;
  const fs::path state = state_folder();
  return !state.empty() && has_journal(state / name) ? state / name : name;
}

fs::path untitled_folder(const fs::path& state, const std::string& name) {
  const std::vector<fs::path> sessions = untitled_sessions(state);
  for (std::size_t k = kept_sessions - 1; k < sessions.size(); ++k) remove_session(sessions[k]);
  return free_folder(state / fmt::format("{} {}", time_after(sessions), plain(name)));
}

std::optional<EarlierSession> earlier_session(const fs::path& state, const fs::path& folder) {
  if (!has_journal(folder)) return std::nullopt;
  try {
    return earlier_session_of(state, folder, read_journal(folder));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

std::optional<EarlierSession> unfinished_session(const fs::path& state) {
  std::vector<fs::path> folders = untitled_sessions(state);
  std::ranges::copy_if(recent_files(state), std::back_inserter(folders), has_journal);  // those opened from elsewhere
  return first_session(state, folders, [](const Journal& journal) { return !journal.closed; });
}

std::optional<EarlierSession> last_session(const fs::path& state) {
  std::vector<fs::path> folders = recent_files(state);
  std::erase_if(folders, [](const fs::path& folder) { return !has_journal(folder); });
  return first_session(state, folders, [](const Journal&) { return true; });
}

void close_session(const fs::path& folder) {
  try {
    Journal ignored;
    JournalWriter::go_on(folder, ignored).close();
  } catch (const std::exception&) {  // then it is offered again
  }
}

}  // namespace nextview
