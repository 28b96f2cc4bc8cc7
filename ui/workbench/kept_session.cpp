#include "ui/workbench/kept_session.hpp"

#include <fmt/format.h>

#include "core/session/untitled_sessions.hpp"

namespace nextview {

void KeptSession::begin(const Session& session) {
  if (folder_) return;
  try {
    folder_ = state_.empty() ? SessionFolder::in_memory(session)
                             : SessionFolder::begin(OutputFolder(untitled_folder(state_, session.name()), {}), session);
  } catch (const std::runtime_error& error) {
    folder_ = SessionFolder::in_memory(session);
    not_kept(error.what());
  }
}

bool KeptSession::step(Session& session, const Progress& progress, const std::stop_token& stop) {
  closed_ = false;
  begin(session);
  return folder_->step(session, progress, stop, [this](const std::string& reason) { not_kept(reason); });
}

void KeptSession::follow(const Session& session, const SessionFolder::Line& line, const Branches& branches) {
  if (!folder_) return;
  closed_ = false;
  const auto follow_all = [&] {
    folder_->stand_at(line);
    folder_->keep_branches(branches);
    folder_->keep_configuration(session);
  };
  try {
    follow_all();
  } catch (const std::runtime_error& error) {
    not_kept(error.what());
    folder_->leave();
    follow_all();  // in memory
  }
}

void KeptSession::close(const Session* session) {
  if (!folder() || closed_) return;
  try {
    if (session) keep_state(*session);
    folder_->close();
    closed_ = true;
  } catch (const std::exception&) {  // it will be offered again: nothing is lost
  }
}

/// Without it the session opens all the same, and takes longer.
void KeptSession::keep_state(const Session& session) {
  try {
    folder_->keep_state(session);
  } catch (const std::exception&) {
  }
}

void KeptSession::not_kept(const std::string& reason) {
  if (notice_) notice_(fmt::format("{}; the session goes on in memory: export keeps it elsewhere", reason));
}

}  // namespace nextview
