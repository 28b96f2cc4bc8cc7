#include "core/session/session_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/file/atomic_file.hpp"
#include "core/journal/capture_file.hpp"
#include "core/session/state_file.hpp"
#include "core/session/step_outcome.hpp"
#include "core/session/timings.hpp"

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

JournalStep step_of(const NextView& choice, const Acquired& acquired) {
  JournalStep step;
  step.wanted = acquired.wanted;
  step.candidate = choice.candidate;
  step.is_custom = choice.is_custom;
  step.overridden = choice.overridden;
  step.gain = choice.gain;
  step.gain_unit = choice.gain_unit;
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

/// What came of a step, as far as it is known.
void keep_result(JournalWriter& writer, const JournalStep& step) {
  if (!step.outcome.empty()) writer.keep_outcome(step.number, step.outcome);
  if (!step.reach.empty()) writer.keep_reach(step.number, step.reach);
}

/// And the captures that it names, also if no list of files does. @throws JournalInUse
void remove_journal(const fs::path& folder) {
  Journal journal;
  try {
    const JournalWriter lock = JournalWriter::go_on(folder, journal);
  } catch (const JournalInUse&) {
    throw;
  } catch (const std::runtime_error&) {  // it cannot be read: no capture is known
  }
  std::error_code ignored;
  for (const auto& [number, step] : journal.steps)
    if (is_plain_file(folder / scans_name / step.scan)) fs::remove(folder / scans_name / step.scan, ignored);
  if (is_plain_file(folder / journal_name)) fs::remove(folder / journal_name, ignored);
}

}  // namespace

SessionFolder SessionFolder::begun(OutputFolder out, const JournalInput& input, const Session& session) {
  const std::string text = to_toml(session.configuration(), out.path());
  JournalWriter writer = JournalWriter::begin(out.path(), input, text);
  write_file(out.claim("config.toml"), text);
  SessionFolder result(std::move(out), std::move(writer), input);
  result.settings_ = {text};
  return result;
}

SessionFolder SessionFolder::begin(OutputFolder out, const Session& session) {
  if (has_journal(out.path())) remove_journal(out.path());
  const bool has_object = session.mesh() && !session.recording();
  out.begin("scan", has_object ? std::optional(session.object_file()) : std::nullopt);
  const fs::path folder = out.claim(journal_name).parent_path();
  const JournalInput input = input_of(session, folder);
  return begun(std::move(out), input, session);
}

SessionFolder SessionFolder::in_memory(const Session& session, const SavedSession* saved) {
  SessionFolder result(input_of(session, "/"));
  result.settings_ = {to_toml(session.configuration(), "/")};
  if (!saved || !saved->journal) return result;
  const Journal& journal = *saved->journal;
  result.input_.hash = journal.input.hash;
  result.settings_ = journal.settings;
  result.branches_ = journal.branches;
  result.steps_ = journal.steps;
  result.last_ = journal.last_number();
  result.take_into_memory(saved->folder);
  return result;
}

SessionFolder SessionFolder::go_on(OutputFolder out, const SavedSession& saved, const Session& session) {
  out.go_on("scan");
  const fs::path folder = out.claim(journal_name).parent_path();
  if (!saved.journal) return begun(std::move(out), input_of(session, folder), session);
  Journal now = *saved.journal;
  SessionFolder result(std::move(out), JournalWriter::go_on(folder, now), saved.journal->input);
  if (now.at != saved.journal->at || now.last_number() != saved.journal->last_number())
    throw JournalInUse(fmt::format("{}: another program has written this session", folder.string()));
  result.last_ = now.last_number();
  result.branches_ = std::move(now.branches);
  result.steps_ = std::move(now.steps);
  result.settings_ = std::move(now.settings);
  return result;
}

bool SessionFolder::step(Session& session, const Progress& progress, const std::stop_token& stop,
                         const NotKept& not_kept) {
  const NextView choice = session.state().next;
  const auto write = [&](const auto& what) {
    if (!keeps_) return;
    try {
      what();
    } catch (const std::runtime_error& error) {
      if (!not_kept) throw;
      leave();
      not_kept(error.what());
    }
  };
  const auto accept = [&](const Acquired& acquired) {
    if (pending_) write([&] { withdraw(); });
    JournalStep& step = add_step(choice, acquired);
    write([&] {
      out_->claim(fmt::format("{}/{}", scans_name, capture_name(acquired.capture, step.number)));
      writer_->add(step, acquired.capture);
    });
    if (!keeps_) captures_.insert_or_assign(step.number, acquired.capture);
    return true;
  };
  const bool taken = session.step(progress, stop, accept);
  if (!taken || !pending_) return taken;
  const std::uint32_t number = *std::exchange(pending_, std::nullopt);
  branches_.add_step(number, line_.empty() ? 0 : line_.back());
  line_.push_back(number);
  JournalStep& step = steps_.at(number);
  step.outcome = outcome_of(session.records().back());
  if (session.has_live_robot()) step.reach = reach_of(session.records().back());
  write([&] { keep_result(*writer_, step); });
  return true;
}

/// What is kept, and not taken after all.
void SessionFolder::withdraw() {
  writer_->stand_at(line_.empty() ? 0 : line_.back());
  writer_->keep_branches(branches_);
  pending_.reset();
}

JournalStep& SessionFolder::add_step(const NextView& choice, const Acquired& acquired) {
  JournalStep step = step_of(choice, acquired);
  step.number = last_ + 1;
  step.after = line_.empty() ? 0 : line_.back();
  step.settings = settings_.size();
  pending_ = last_ = step.number;
  return steps_.insert_or_assign(step.number, std::move(step)).first->second;
}

void SessionFolder::leave() {
  if (std::exchange(keeps_, false)) take_into_memory(path());
}

void SessionFolder::take_into_memory(const fs::path& folder) {
  for (const auto& [number, step] : steps_) {
    try {
      captures_.emplace(number, read_capture(step, folder));
    } catch (const std::runtime_error&) {  // who copies the session hears of it
    }
  }
}

void SessionFolder::stand_at(const Line& line) {
  if (pending_ && keeps_) withdraw();
  pending_.reset();
  if (line == line_) return;
  line_ = line;
  if (keeps_) writer_->stand_at(line.empty() ? 0 : line.back());
}

void SessionFolder::keep_branches(const Branches& branches) {
  if (branches == branches_) return;
  branches_ = branches;
  if (keeps_) writer_->keep_branches(branches);
}

void SessionFolder::keep_configuration(const Session& session) {
  std::string text = to_toml(session.configuration(), out_ ? path() : std::filesystem::path("/"));
  if (text == settings_.back()) return;
  settings_.push_back(std::move(text));
  if (!keeps_) return;
  writer_->keep_settings(settings_.back());
  write_file(out_->claim("config.toml"), settings_.back());
}

void SessionFolder::keep_state(const Session& session) {
  if (!keeps_) return;
  std::vector<JournalStep> line;
  for (const std::uint32_t number : line_) line.push_back(steps_.at(number));
  if (write_state_file(session, line, path() / state_file_name)) out_->claim(state_file_name);
  write_file(out_->claim(timings_name), timings_csv(session));
}

void SessionFolder::close() {
  if (keeps_) writer_->close();
}

void SessionFolder::copy_to(OutputFolder& copy, const Session& session) const {
  JournalInput input = input_of(session, copy.path());
  input.hash = input_.hash;  // of the file that was scanned
  copy.claim(journal_name);
  JournalWriter writer = JournalWriter::begin(copy.path(), input, settings_.front());
  std::size_t settings = 1;
  for (const std::uint32_t number : steps_of_branches()) {
    JournalStep step = steps_.at(number);
    const auto here = captures_.find(number);
    std::optional<Capture> capture;
    try {
      if (here == captures_.end() && !out_) continue;
      capture = here != captures_.end() ? here->second : read_capture(step, path());
    } catch (const std::runtime_error&) {  // it is lost: those after it go on without it, as where it is opened
      continue;
    }
    for (; settings < step.settings; ++settings) writer.keep_settings(settings_[settings]);
    copy.claim(fmt::format("{}/{}", scans_name, capture_name(*capture, number)));
    writer.add(step, *capture);
    keep_result(writer, step);
  }
  writer.keep_settings(to_toml(session.configuration(), copy.path()));
  writer.keep_branches(branches_);
  writer.stand_at(line_.empty() ? 0 : line_.back());
  writer.close();
}

std::set<std::uint32_t> SessionFolder::steps_of_branches() const {
  std::set<std::uint32_t> steps(line_.begin(), line_.end());
  for (const Branch& branch : branches_.all)
    for (auto step = steps_.find(branch.tip); step != steps_.end(); step = steps_.find(step->second.after))
      if (!steps.insert(step->first).second) break;
  return steps;
}

}  // namespace nextview
