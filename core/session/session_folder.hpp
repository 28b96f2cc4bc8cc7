#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
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

  /// A session that is kept nowhere: in memory alone, to be copied to a folder; of a saved one, which is to be
  /// restored, with its captures.
  static SessionFolder in_memory(const Session& session, const SavedSession* saved = nullptr);

  /// Session::step, with the capture kept before it is absorbed. Where it cannot be, the view is not taken, or with
  /// `not_kept` it is, and from there on the session is in memory alone. One that was stopped after its capture is the
  /// last view in the folder all the same, so that who goes on has it, until stand_at() or another step says otherwise.
  /// @throws as Session::step; std::runtime_error naming the file
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
  /// What makes it quick to open (write_state_file), and how long its steps took. @throws std::runtime_error naming the
  /// file
  void keep_state(const Session& session);
  /// Nobody is in the middle of it any more.
  void close();
  /// Makes another folder one of the same session, with its branches, but for lost captures.
  /// @throws std::runtime_error naming the file and the reason @pre copy.begin() was called
  void copy_to(OutputFolder& copy, const Session& session) const;
  /// Nothing can be written any more: what is there is taken into memory, where all else goes from here on.
  void leave();

  OutputFolder& out() { return *out_; }                               ///< @pre not in_memory()
  const std::filesystem::path& path() const { return out_->path(); }  ///< likewise
  bool keeps() const { return keeps_; }                               ///< false where it is in memory alone

 private:
  friend bool restore(Session&, SavedSession&, SessionFolder*, const std::function<void(std::uint32_t)>&,
                      const Progress&, const std::stop_token&);
  friend bool restore_kept(Session&, const SavedSession&, SessionFolder*);
  SessionFolder(OutputFolder out, JournalWriter writer, JournalInput input)
      : out_(std::move(out)), writer_(std::move(writer)), input_(std::move(input)) {}
  explicit SessionFolder(JournalInput input) : input_(std::move(input)), keeps_(false) {}
  static SessionFolder begun(OutputFolder out, const JournalInput& input, const Session& session);
  std::set<std::uint32_t> steps_of_branches() const;
  JournalStep& add_step(const NextView& choice, const Acquired& acquired);
  void withdraw();
  void take_into_memory(const std::filesystem::path& folder);

  std::optional<OutputFolder> out_;
  std::optional<JournalWriter> writer_;
  JournalInput input_;
  std::vector<std::string> settings_;  ///< texts of config.toml, the last one of now
  Line line_;
  Branches branches_;
  std::map<std::uint32_t, JournalStep> steps_;  ///< of this session, by number
  std::map<std::uint32_t, Capture> captures_;   ///< of those that are in memory alone
  std::uint32_t last_ = 0;                      ///< number of the last capture
  std::optional<std::uint32_t> pending_;        ///< kept, and not yet absorbed
  bool keeps_ = true;
};

}  // namespace nextview
