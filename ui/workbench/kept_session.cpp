#include "ui/workbench/kept_session.hpp"

#include <fmt/format.h>

#include "core/file/atomic_file.hpp"
#include "core/session/recent_files.hpp"
#include "core/session/untitled_sessions.hpp"

namespace nextview {

KeptSession::KeptSession(SessionFolder folder, Notice notice) : folder_(std::move(folder)), notice_(std::move(notice)) {
  try {
    if (folder_->keeps()) cameras_ = read_cameras(folder_->path());
  } catch (const std::runtime_error& error) {
    if (notice_) notice_(error.what());
  }
}

void KeptSession::set_cameras(std::vector<CameraBookmark> cameras) {
  cameras_ = std::move(cameras);
  write_cameras();
}

void KeptSession::write_cameras() {
  if (!folder()) return;
  try {
    write_file(folder_->out().claim(cameras_name), cameras_json(cameras_));
  } catch (const std::runtime_error& error) {
    if (notice_) notice_(error.what());
  }
}

void KeptSession::copy_to(OutputFolder& copy, const Session& session) const {
  if (!folder_) return;
  folder_->copy_to(copy, session);
  if (!cameras_.empty()) write_file(copy.claim(cameras_name), cameras_json(cameras_));
}

void KeptSession::begin(const Session& session) {
  if (folder_) return;
  try {
    folder_ = state_.empty() ? SessionFolder::in_memory(session)
                             : SessionFolder::begin(OutputFolder(untitled_folder(state_, session.name()), {}), session);
  } catch (const std::runtime_error& error) {
    folder_ = SessionFolder::in_memory(session);
    not_kept(error.what());
  }
  if (!cameras_.empty()) write_cameras();
}

bool KeptSession::step(Session& session, const Progress& progress, const std::stop_token& stop) {
  closed_ = false;
  begin(session);
  if (folder_->step(session, progress, stop, [this](const std::string& reason) { not_kept(reason); })) {
    if (folder_->line().size() == 1) add_to_recent();  // already: whatever ends the program, it is found again
    return true;
  }
  follow(session, folder_->line(), folder_->branches());  // as the window shows it: without the view
  return false;
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
    add_to_recent();
  } catch (const std::exception&) {  // it will be offered again: nothing is lost
  }
}

void KeptSession::add_to_recent() {
  if (!state_.empty() && folder() && !folder_->line().empty()) add_recent_file(state_, folder_->path());
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
