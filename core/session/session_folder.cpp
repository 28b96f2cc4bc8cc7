#include "core/session/session_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/config/input_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/taken_views.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What the session scans, which must still be the same when it goes on.
JournalInput input_of(const Session& session, const fs::path& folder) {
  const Configuration& c = session.configuration();
  if (!session.recording() && session.mesh())
    return {named_from(folder, session.object_file()), file_hash(session.object_file())};
  if (session.recording()) return {named_from(folder, c.recorded.folder)};
  return {c.driver.name};
}

NextView choice_of(const JournalStep& step) {
  return {step.wanted, step.candidate, step.is_custom, step.overridden, step.gain, step.utility};
}

Acquired acquired_of(const JournalStep& step, Capture capture) {
  Acquired acquired;
  acquired.wanted = step.wanted;
  acquired.reached = step.reached;
  acquired.believed = step.believed;
  acquired.capture = std::move(capture);
  acquired.motion = step.motion;
  acquired.registration = step.registration;
  return acquired;
}

JournalStep step_of(const NextView& choice, const Acquired& acquired) {
  JournalStep step;
  step.wanted = acquired.wanted;
  step.candidate = choice.candidate;
  step.is_custom = choice.is_custom;
  step.overridden = choice.overridden;
  step.gain = choice.gain;
  step.utility = choice.utility;
  step.reached = acquired.reached;
  step.believed = acquired.believed;
  step.T_world_camera = acquired.capture.T_world_camera;
  step.max_range = acquired.capture.max_range;
  step.motion = acquired.motion;
  step.registration = acquired.registration;
  if (const auto* image = std::get_if<DepthImage>(&acquired.capture.measured)) step.camera = image->camera;
  return step;
}

/// The part of a job's progress that is its k-th of n steps.
Progress part(const Progress& whole, std::size_t k, std::size_t n) {
  if (!whole) return {};
  return [=](double fraction, std::string_view) {
    whole((double(k) + fraction) / double(n), fmt::format("going through view {} of {} again", k + 1, n));
  };
}

/// The journal's settings hold: the file beside it may have been lost, or changed.
void repair_configuration(const Journal& journal, const fs::path& folder, std::vector<std::string>& notices) {
  const fs::path file = folder / "config.toml";
  if (journal.settings.empty() || (is_there(file) && read_file(file) == journal.settings)) return;
  write_file(file, journal.settings);
  notices.emplace_back("config.toml was not as the session wrote it, and is so again");
}

using Step = std::function<bool(const Progress&)>;

/// A scan without a journal: from the same poses the simulation senses the same.
bool sense_again(Session& session, const SavedSession& saved, const Step& step, const std::function<void()>& each,
                 const Progress& progress) {
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
    if (!step(part(progress, k, poses.size()))) return false;
    if (each) each();
  }
  return true;
}

bool holds_nothing_but(std::span<const InputFile> inputs, const fs::path& folder) {
  std::error_code error;
  const auto is_input = [&](const fs::directory_entry& entry) {
    std::error_code ignored;
    return std::ranges::any_of(inputs, [&](const auto& input) { return fs::equivalent(entry, input.path, ignored); });
  };
  return fs::is_directory(folder, error) && std::all_of(fs::directory_iterator(folder, error), fs::directory_iterator(), is_input);
}

}  // namespace

bool is_session(const fs::path& folder) {
  return has_journal(folder) || (is_there(folder / "config.toml") && is_there(folder / "views.csv"));
}

SavedSession read_session(const fs::path& folder) {
  if (!is_session(folder)) throw std::runtime_error(fmt::format("{}: holds no session", folder.string()));
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
  require_same_object(folder, resolve_object(c));
  saved.notices.emplace_back("an earlier version left no scans there: its views are sensed again");
  return saved;
}

void require_free_for_session(const fs::path& folder, bool overwrite, std::span<const InputFile> inputs) {
  if (!is_there(folder) || holds_nothing_but(inputs, folder)) return;
  const auto manifest = read_manifest(folder);
  const std::string another = fmt::format("give another folder, for example --out {}", free_folder(folder).string());
  if (!is_session(folder) && !(manifest && manifest->command == "scan"))
    throw std::invalid_argument(fmt::format("{}: is not empty, and holds no session; {}", folder.string(), another));
  if (!overwrite)
    throw std::invalid_argument(fmt::format(
        "{}: holds a session: --resume goes on with it, --overwrite replaces it; or {}", folder.string(), another));
}

bool restore(Session& session, SavedSession& saved, SessionFolder* folder, const std::function<void()>& each,
             const Progress& progress, const std::stop_token& stop) {
  if (!saved.journal) {
    const Step step = [&](const Progress& p) {
      return folder ? folder->step(session, p, stop) : session.step(p, stop);
    };
    return sense_again(session, saved, step, each, progress);
  }
  const std::vector<JournalStep> line = saved.journal->line();
  for (std::size_t k = 0; k < line.size(); ++k) {
    Capture capture;
    try {
      capture = read_capture(line[k], saved.folder);
    } catch (const std::runtime_error& error) {
      saved.notices.push_back(fmt::format("view {} is left out: {}", k + 1, error.what()));
      continue;
    }
    if (!session.step_again(choice_of(line[k]), acquired_of(line[k], std::move(capture)),
                            part(progress, k, line.size()), stop))
      return false;
    if (folder) folder->line_.push_back(line[k].number);
    if (each) each();
  }
  return true;
}

SessionFolder SessionFolder::begin(OutputFolder out, const Session& session) {
  JournalText ignored;
  if (has_journal(out.path())) JournalFile::go_on(out.path() / journal_name, ignored);  // is it free?
  const bool has_object = session.mesh() && !session.recording();
  out.begin("scan", has_object ? std::optional(session.object_file()) : std::nullopt);
  const fs::path folder = out.claim(journal_name).parent_path();
  const JournalInput input = input_of(session, folder);
  SessionFolder result(std::move(out), JournalWriter::begin(folder, input), input);
  result.keep_configuration(session);
  return result;
}

SessionFolder SessionFolder::go_on(OutputFolder out, const SavedSession& saved, const Session& session) {
  out.go_on("scan");
  const fs::path folder = out.claim(journal_name).parent_path();
  const JournalInput input = input_of(session, folder);
  if (!saved.journal) {
    SessionFolder result(std::move(out), JournalWriter::begin(folder, input), input);
    result.keep_configuration(session);
    return result;
  }
  Journal now;
  SessionFolder result(std::move(out), JournalWriter::go_on(folder, now), input);
  if (now.at != saved.journal->at || now.last_number() != saved.journal->last_number())
    throw JournalInUse(fmt::format("{}: another program has written this session", folder.string()));
  result.last_ = now.last_number();
  result.steps_ = std::move(now.steps);
  result.settings_ = std::move(now.settings);
  return result;
}

bool SessionFolder::step(Session& session, const Progress& progress, const std::stop_token& stop,
                         const NotKept& not_kept) {
  const NextView choice = session.state().next;
  const auto accept = [&](const Acquired& acquired) {
    if (!keeps_) return true;
    try {
      keep(choice, acquired);
    } catch (const std::runtime_error& error) {
      if (!not_kept) throw;
      keeps_ = false;
      not_kept(error.what());
    }
    return true;
  };
  const bool taken = session.step(progress, stop, accept);
  if (!keeps_) return taken;
  if (taken)
    line_.push_back(*pending_);
  else if (pending_)
    writer_.stand_at(line_.empty() ? 0 : line_.back());
  pending_.reset();
  return taken;
}

void SessionFolder::keep(const NextView& choice, const Acquired& acquired) {
  JournalStep step = step_of(choice, acquired);
  step.number = last_ + 1;
  step.after = line_.empty() ? 0 : line_.back();
  const bool is_image = std::holds_alternative<DepthImage>(acquired.capture.measured);
  out_.claim(fmt::format("{}/{:04}.{}", scans_name, step.number, is_image ? "npy" : "ply"));
  writer_.add(step, acquired.capture);
  pending_ = last_ = step.number;
  steps_.emplace(step.number, std::move(step));
}

void SessionFolder::stand_at(const Line& line) {
  if (!keeps_ || (line == line_ && !pending_)) return;
  writer_.stand_at(line.empty() ? 0 : line.back());
  line_ = line;
  pending_.reset();
}

void SessionFolder::keep_configuration(const Session& session) {
  std::string text = to_toml(session.configuration(), path());
  if (!keeps_ || text == settings_) return;
  writer_.keep_settings(text);
  write_file(out_.claim("config.toml"), text);
  settings_ = std::move(text);
}

void SessionFolder::close() {
  if (keeps_) writer_.close();
}

void SessionFolder::copy_to(OutputFolder& copy, const Session& session) const {
  JournalInput input = input_;
  if (input.hash) input.path = named_from(copy.path(), path() / input.path);
  copy.claim(journal_name);
  JournalWriter writer = JournalWriter::begin(copy.path(), input);
  writer.keep_settings(to_toml(session.configuration(), copy.path()));
  std::uint32_t number = 0;
  for (const std::uint32_t of_line : line_) {
    JournalStep step = steps_.at(of_line);
    const Capture capture = read_capture(step, path());
    step.after = number++;
    step.number = number;
    copy.claim(fmt::format("{}/{:04}{}", scans_name, number, fs::path(step.scan).extension().string()));
    writer.add(step, capture);
  }
  writer.close();
}

}  // namespace nextview
