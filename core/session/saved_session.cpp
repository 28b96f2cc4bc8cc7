#include "core/session/saved_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/config/configuration_text.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "core/file/readable_folder.hpp"
#include "core/file/temporary_file.hpp"
#include "core/journal/capture_file.hpp"
#include "core/progress/part.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/state_file.hpp"
#include "core/session/taken_views.hpp"
#include "core/setting/mistyped_path.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

NextView choice_of(const JournalStep& step) {
  return {step.wanted, step.candidate, step.is_custom, step.overridden, step.gain, step.utility, step.gain_unit};
}

Acquired acquired_of(const JournalStep& step, Capture capture) {
  Acquired acquired;
  acquired.wanted = step.wanted;
  acquired.reached = step.reached;
  acquired.believed = step.believed;
  acquired.capture = std::move(capture);
  acquired.motion = step.motion;
  acquired.registration = step.registration;
  acquired.reach = step.reach;
  return acquired;
}

/// @throws CaptureLost where a recording is gone through, and the view is none of its frames
void require_frame(const Session& session, const JournalStep& step) {
  const std::size_t frames = session.setup().source.frames.size();
  const std::uint32_t frame = step.wanted.frame.value_or(0);
  if (session.recording() && frame >= frames)
    throw CaptureLost(fmt::format("it is of frame {}, and the recording has {}", frame + 1, frames));
}

/// Of the k-th of n views.
Progress part_of_view(const Progress& whole, std::size_t k, std::size_t n) {
  if (!whole) return {};
  return [report = part(whole, double(k) / double(n), double(k + 1) / double(n)), k, n](double fraction,
                                                                                        std::string_view) {
    report(fraction, fmt::format("going through view {} of {} again", k + 1, n));
  };
}

/// The journal's settings hold: the file beside it may have been lost, or changed.
void repair_configuration(const Journal& journal, const fs::path& folder, std::vector<std::string>& notices) {
  const fs::path file = folder / "config.toml";
  if (journal.settings.empty() || (is_there(file) && read_file(file) == journal.settings.back())) return;
  write_file(file, journal.settings.back());
  notices.emplace_back("config.toml was not as the session wrote it, and is so again");
}

using Step = std::function<bool(const Progress&)>;

/// A scan without a journal: from the same poses the simulation senses the same.
bool sense_again(Session& session, const SavedSession& saved, const Step& step,
                 const std::function<void(std::uint32_t)>& each, const Progress& progress) {
  const std::vector<Pose> poses = views_taken(saved.folder / "views.csv", session.configuration());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::vector<Pose>& candidates = session.candidates();
    const auto same = std::ranges::find_if(candidates, [&](const Pose& p) { return p.matrix() == poses[k].matrix(); });
    const auto candidate = std::size_t(same - candidates.begin());
    if (k > 0 && session.next_candidate() != candidate) {
      if (candidate < candidates.size())
        session.override_next_view(candidate);
      else
        session.override_next_view(poses[k]);
    }
    if (!step(part_of_view(progress, k, poses.size()))) return false;
    if (each) each(static_cast<std::uint32_t>(k + 1));
  }
  return true;
}

bool holds_nothing_but(std::span<const InputFile> inputs, const fs::path& folder) {
  std::error_code error;
  const auto is_input = [&](const fs::directory_entry& entry) {
    std::error_code ignored;
    return std::ranges::any_of(inputs, [&](const auto& input) { return fs::equivalent(entry, input.path, ignored); });
  };
  return fs::is_directory(folder, error) &&
         std::all_of(fs::directory_iterator(folder, error), fs::directory_iterator(), is_input);
}

/// No view was ever taken in it: its first move failed, for example. False where that cannot be told.
bool is_without_views(const fs::path& folder) {
  if (!has_journal(folder)) return false;
  try {
    const Journal journal = read_journal(folder);
    return journal.steps.empty() && journal.damage.empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

void require_session(const fs::path& folder) {
  require_readable(folder);
  if (is_session(folder)) return;
  std::error_code unseen;  // what cannot be looked at holds none for us
  const std::string reason = !is_there(folder)                   ? "there is no such folder"
                             : !fs::is_directory(folder, unseen) ? "is a file"
                                                                 : "holds no session";
  const std::string advice = "; give the folder of a session, as `nextview scan --out` leaves it";
  throw std::runtime_error(fmt::format("{}: {}{}", folder.string(), reason,
                                       is_there(folder) ? advice : did_you_mean_path(folder, {}, advice, is_session)));
}

}  // namespace

bool is_session(const fs::path& folder) {
  return has_journal(folder) || (is_there(folder / "config.toml") && is_there(folder / "views.csv"));
}

SavedSession read_session(const fs::path& folder) {
  require_session(folder);
  SavedSession saved;
  saved.folder = folder;
  if (has_journal(folder)) {
    saved.journal = read_journal(folder);
    saved.notices = saved.journal->damage;
    require_same_input(*saved.journal, folder);
    repair_configuration(*saved.journal, folder, saved.notices);
    saved.configuration = read_configuration(folder / "config.toml");
    return saved;
  }
  saved.configuration = read_configuration(folder / "config.toml");
  const Configuration& c = saved.configuration;
  if (!c.recorded.folder.empty() || !c.driver.name.empty())
    throw std::runtime_error(fmt::format("{}: has no journal: what was captured is not there", folder.string()));
  if (is_there(folder / scans_name))
    throw std::runtime_error(
        fmt::format("{}: its journal is gone, which says what its {} are; scan them anew into another folder: "
                    "nextview scan --config {}",
                    folder.string(), scans_name, (folder / "config.toml").string()));
  require_same_object(folder, resolve_object(c));
  saved.notices.emplace_back("an earlier version left no scans there: its views are sensed again");
  return saved;
}

InTheWay in_the_way(const fs::path& folder, std::span<const InputFile> inputs) {
  if (!is_there(folder)) return InTheWay::nothing;
  remove_abandoned_temporary_files(folder);  // of a session that was ended as it began
  if (holds_nothing_but(inputs, folder) || is_without_views(folder)) return InTheWay::nothing;
  const auto manifest = read_manifest(folder);
  return is_session(folder) || (manifest && manifest->command == "scan") ? InTheWay::session : InTheWay::others;
}

void require_no_session(const fs::path& folder) {
  if (in_the_way(folder, {}) == InTheWay::session)
    throw std::invalid_argument(
        fmt::format("{}: holds a session, which would be lost; give another folder, for example --out {}",
                    folder.string(), free_folder(folder).string()));
}

Configuration began_with(const SavedSession& saved) {
  Configuration configuration = saved.configuration;
  if (saved.journal && !saved.journal->settings.empty())
    configuration.views = configuration_of(saved.journal->settings.front(), "config.toml").views;
  return configuration;
}

PlanningConfig chosen_by(const SavedSession& saved, const JournalStep& step) {
  if (step.settings == 0) return planning_of(saved.configuration);
  return planning_of(configuration_of(saved.journal->settings.at(step.settings - 1), "config.toml"));
}

Configuration settings_at(const SavedSession& saved, std::uint32_t number) {
  const Journal& journal = *saved.journal;
  const auto texts = journal.settings_at.find(number);
  if (texts == journal.settings_at.end() || texts->second == 0) return saved.configuration;
  return configuration_of(journal.settings.at(texts->second - 1), "config.toml");
}

bool restore_kept(Session& session, const SavedSession& saved, SessionFolder* folder) {
  if (!saved.journal) return false;
  const std::vector<JournalStep> line = saved.journal->line();
  const PlanningConfig began = session.planning();
  session.set_planning(planning_of(saved.configuration));
  auto state = read_state_file(session, line, saved.folder);
  if (!state) {
    session.set_planning(began);
    return false;
  }
  session.restore(*std::move(state));
  if (folder)
    for (const JournalStep& step : line) folder->line_.push_back(step.number);
  return true;
}

bool take_again(Session& session, SavedSession& saved, std::span<const JournalStep> line,
                const std::function<void(std::uint32_t)>& each, const Progress& progress, const std::stop_token& stop) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    // As it went: a view is ranked and taken, and only then may another planner rank the next one.
    session.set_planning(chosen_by(saved, line[k]), {}, stop);
    Capture capture;
    try {
      require_frame(session, line[k]);
      capture = read_capture(line[k], saved.folder);
    } catch (const CaptureLost& error) {
      saved.notices.push_back(fmt::format("a view is left out: {}", error.what()));
      continue;
    }
    if (!session.step_again(choice_of(line[k]), acquired_of(line[k], std::move(capture)),
                            part_of_view(progress, k, line.size()), stop))
      return false;
    const bool is_last = k + 1 == line.size();
    session.set_planning(is_last ? planning_of(settings_at(saved, line[k].number)) : chosen_by(saved, line[k + 1]), {},
                         stop);
    each(line[k].number);
  }
  return true;
}

bool restore(Session& session, SavedSession& saved, SessionFolder* folder,
             const std::function<void(std::uint32_t)>& each, const Progress& progress, const std::stop_token& stop) {
  if (!each && restore_kept(session, saved, folder)) return true;
  if (!saved.journal) {
    const Step step = [&](const Progress& p) {
      return folder ? folder->step(session, p, stop) : session.step(p, stop);
    };
    return sense_again(session, saved, step, each, progress);
  }
  const std::vector<JournalStep> line = saved.journal->line();
  const auto taken = [&](std::uint32_t number) {
    if (folder) folder->line_.push_back(number);
    if (each) each(number);
  };
  if (!take_again(session, saved, line, taken, progress, stop)) return false;
  session.set_planning(planning_of(saved.configuration), {}, stop);
  return true;
}

}  // namespace nextview
