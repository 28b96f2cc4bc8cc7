#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/journal/journal.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {

/// A session's folder, written while the session goes on: whatever ends the program, each view that was accepted is
/// there, and can be gone on from.
class SessionFolder {
 public:
  using Line = std::vector<std::uint32_t>;  ///< numbers of captures
  /// Hears why a view could not be kept.
  using NotKept = std::function<void(const std::string&)>;

  /// Makes it the folder of a session without views: its configuration, and an empty journal. What an earlier session
  /// left there goes. @throws JournalInUse if another program writes that one; std::runtime_error naming the file and
  /// the reason
  static SessionFolder begin(OutputFolder out, const Session& session);
  /// Goes on with a saved one, which is to be restored. @throws as begin()
  static SessionFolder go_on(OutputFolder out, const SavedSession& saved, const Session& session);

  /// Session::step, with the capture kept before it is absorbed. Where it cannot be, the view is not taken, or with
  /// `not_kept` it is, and from there on nothing is kept. @throws as Session::step; std::runtime_error naming the file
  bool step(Session& session, const Progress& progress = {}, const std::stop_token& stop = {},
            const NotKept& not_kept = {});
  /// The session has been put where its views were these.
  void stand_at(const Line& line);
  /// The captures that the session's views are of.
  const Line& line() const { return line_; }
  const Branches& branches() const { return branches_; }
  /// It has these branches from here on. @pre the session stands on the current one
  void keep_branches(const Branches& branches);
  /// The settings have changed in a way that what was scanned stays.
  void keep_configuration(const Session& session);
  /// What makes it quick to open (write_state_file). @throws std::runtime_error naming the file
  void keep_state(const Session& session);
  /// Nobody is in the middle of it any more.
  void close();
  /// Makes another folder one of the same session, with the views that it stands at. @pre copy.begin() was called
  void copy_to(OutputFolder& copy, const Session& session) const;

  OutputFolder& out() { return out_; }
  const std::filesystem::path& path() const { return out_.path(); }
  bool keeps() const { return keeps_; }  ///< false once something could not be kept

 private:
  friend bool restore(Session&, SavedSession&, SessionFolder*, const std::function<void(std::uint32_t)>&,
                      const Progress&, const std::stop_token&);
  friend bool restore_kept(Session&, const SavedSession&, SessionFolder*);
  SessionFolder(OutputFolder out, JournalWriter writer, JournalInput input)
      : out_(std::move(out)), writer_(std::move(writer)), input_(std::move(input)) {}
  static SessionFolder begun(OutputFolder out, const JournalInput& input, const Session& session);
  void keep(const NextView& choice, const Acquired& acquired);
  void withdraw();

  OutputFolder out_;
  JournalWriter writer_;
  JournalInput input_;
  std::string settings_;  ///< text of config.toml
  Line line_;
  Branches branches_;
  std::map<std::uint32_t, JournalStep> steps_;  ///< of this session, by number
  std::uint32_t last_ = 0;                      ///< number of the last capture
  std::optional<std::uint32_t> pending_;        ///< kept, and not yet absorbed
  bool keeps_ = true;
};

}  // namespace nextview
