#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/file/same_file.hpp"
#include "core/session/camera_bookmarks.hpp"
#include "core/session/session_folder.hpp"

namespace nextview {

/// Where a session of the window is kept as it goes on. What cannot be written is said once; the session then goes on
/// in memory alone.
class KeptSession {
 public:
  using Notice = std::function<void(const std::string&)>;

  /// Below `state`, in a folder that is made with the first view; an empty path: nowhere.
  KeptSession(std::filesystem::path state, Notice notice)
      : state_(std::move(state)), wanted_(!state_.empty()), notice_(std::move(notice)) {}
  /// In the folder that it was opened from.
  KeptSession(SessionFolder folder, Notice notice);
  ~KeptSession() { close(nullptr); }
  KeptSession(const KeptSession&) = delete;
  KeptSession& operator=(const KeptSession&) = delete;

  /// Before the first view, or with it: from here on captures are kept, in a folder or, where that cannot be, in
  /// memory.
  void begin(const Session& session);
  /// Session::step, kept. @throws as that
  bool step(Session& session, const Progress& progress, const std::stop_token& stop);
  /// The session was put to where its views were these, maybe with other branches or another end.
  void follow(const Session& session, const SessionFolder::Line& line, const Branches& branches);
  /// The number of the last capture; none if captures are not kept.
  std::optional<std::uint32_t> last_number() const {
    return folder_ && !folder_->line().empty() ? std::optional(folder_->line().back()) : std::nullopt;
  }
  /// Nobody is in the middle of it, and an untitled one comes first among the recent files. With what makes it quick to
  /// open, if the session is given.
  void close(const Session* session);
  const std::vector<CameraBookmark>& cameras() const { return cameras_; }
  /// Into its folder, if it has one yet; else with the first view.
  void set_cameras(std::vector<CameraBookmark> cameras);
  /// Null if it is kept nowhere.
  SessionFolder* folder() { return folder_ && folder_->keeps() ? &*folder_ : nullptr; }
  /// It was to be kept, and what is done to it is in memory alone.
  bool fails() const { return wanted_ && folder_ && !folder_->keeps(); }
  bool is_in(const std::filesystem::path& folder) const {
    return folder_ && folder_->keeps() && same_file(folder_->path(), folder);
  }
  /// What is kept, wherever; null if nothing is.
  SessionFolder* record() { return folder_ ? &*folder_ : nullptr; }
  /// Makes another folder one of the same session, also where this one is in memory alone. Nothing without captures.
  void copy_to(OutputFolder& copy, const Session& session) const;

 private:
  void add_to_recent();
  void keep_state(const Session& session);
  void not_kept(const std::string& reason);
  void write_cameras();

  std::filesystem::path state_;
  bool wanted_ = true;  ///< somewhere
  std::optional<SessionFolder> folder_;
  bool closed_ = false;
  std::vector<CameraBookmark> cameras_;
  Notice notice_;
};

}  // namespace nextview
