#pragma once
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/gibbs/gibbs_state.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/scan_history.hpp"
#include "ui/workbench/seen_surface.hpp"
#include "ui/workbench/session_request.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// Does what a window wants of sessions, one thing after the other, on the thread that calls: starting them, stepping,
/// going back, refining. What came of it is in snapshot().
class SessionRunner {
 public:
  SessionRunner() = default;
  ~SessionRunner();
  SessionRunner(const SessionRunner&) = delete;
  SessionRunner& operator=(const SessionRunner&) = delete;

  struct JobControl {
    Progress progress;                                       ///< of the job
    std::function<void(const SamplerDiagnostics&)> sampler;  ///< how the refinement goes
    std::stop_token stop;
    std::function<void()> shown = {};  ///< there is another snapshot already, though the job goes on
  };

  /// Sessions are kept below this folder as they go on; `notice` hears, a line each, what could not be. Without it,
  /// none is.
  void keep_sessions(std::filesystem::path state, KeptSession::Notice notice);
  /// Never null. The snapshot before stays as it was.
  std::shared_ptr<const SessionSnapshot> snapshot() const { return snapshot_; }
  bool can_step() const { return session_ && session_->finished().empty(); }
  Configuration configuration() const { return session_ ? session_->configuration() : wanted_; }

  /// The session before stays if this one cannot be made; a live scanner, too. @throws std::exception, Stopped
  void load(Configuration configuration, const JobControl& control);
  /// The same with what a user opens, or with what was scanned before a live scanner, which is left.
  void open(const std::filesystem::path& input, const JobControl& control);
  void disconnect(const JobControl& control);
  /// The same with a live scanner. @throws as connect_scanner, too
  void connect(const ScannerWishes& wishes, std::optional<Configuration> configuration, const JobControl& control);
  /// @throws std::runtime_error with the reason
  void reconnect(const JobControl& control);
  /// The scan stays; what it has taken so far may be all there is to it, or it may go on.
  /// @throws std::invalid_argument if it is not valid
  void set_termination(const TerminationConfig& termination);
  /// Other views are ranked, or by another planner, from here on; the scan stays. @throws as Session::set_planning
  void set_planning(const PlanningConfig& planning, const JobControl& control);
  /// Nothing without a session that can step.
  /// `judge` is asked of a scan that does not fit those before it (Session::Judge). `with_last`: one undo takes back
  /// this and the change of the limits before it, which is taken back at once where no view is taken.
  void step(const JobControl& control, const Session::Judge& judge = {}, bool with_last = false);
  void take_view(std::size_t candidate);
  void take_custom_view(const Pose& T_world_camera);
  void undo(const JobControl& control);
  void redo(const JobControl& control);
  /// Goes to where a branch had so many views, or to its end: nothing is captured. An empty name: the current one.
  /// @throws std::invalid_argument: there is none of this name, or it has fewer; likewise the next ones
  void go_to(const std::string& branch, std::optional<std::size_t> views, const JobControl& control);
  /// What is taken from here on is on another branch. An empty name: the next that is free.
  void begin_branch(const std::string& name);
  void rename_branch(const std::string& name, const std::string& to);
  void remove_branch(const std::string& name);
  /// Shows the end of another branch beside this one, or, view for view from now on, where it had as many as this one
  /// has; an empty name: no more.
  void compare(const std::string& name, const JobControl& control, bool view_for_view = false);
  /// With the session, where that is kept. Nothing without one. @throws std::invalid_argument
  void keep_camera(const CameraBookmark& camera);
  void remove_camera(const std::string& name);
  void refine(int chains, int sweeps, const JobControl& control);
  /// Writes what `nextview scan` writes, and the Gibbs map that is shown. Returns a line for people on each surface.
  std::vector<std::string> write(const std::filesystem::path& folder, const JobControl& control);
  /// Writes one thing of it that needs no drawing. Returns the files.
  std::vector<std::filesystem::path> write_one(const request::ExportOne& wanted, const JobControl& control);
  /// What opening a session or an object put off, so that it is shown at once: what the candidates can see, then what
  /// earlier views had, one view at a time. False if nothing is left to be done. @throws Stopped; OutOfMemory
  bool catch_up(const std::stop_token& stop);
  bool is_behind() const { return sight_put_off_ || !put_off_.empty(); }
  void forget_runs();
  /// Shown until the next thing that works.
  void set_message(const std::string& message);

 private:
  HistoryEntry now() const;
  static Stand stand_of(const Session& session, std::shared_ptr<SeenSurface> seen);
  void remember(HistoryEntry before);
  void take_back_limits();
  void choose(const std::function<void()>& change);
  void choose_again(const NextView& chosen);
  void change_branches(const std::function<void(Branches&)>& change);
  void change_cameras(const std::function<void(std::vector<CameraBookmark>&)>& change);
  bool is_own(const std::filesystem::path& folder) const;
  void adopt_opened(const std::shared_ptr<Session>& session, const std::shared_ptr<KeptSession>& kept,
                    const std::shared_ptr<StepTree>& tree);
  static Stand stand_as_saved(const Session& session, std::shared_ptr<SeenSurface> seen, const SavedSession& saved,
                              std::uint32_t number);
  std::shared_ptr<KeptSession> kept_of(SavedSession& saved, const Session& session) const;
  Stand stand_at(std::uint32_t number, const JobControl& control);
  void tell_notices(const SavedSession& saved, std::size_t first) const;
  void follow_compared(const JobControl& control);
  void go_on_comparing(const std::string& branch, const JobControl& control);
  SessionSnapshot snapshot_of(const Stand& stand);
  void start(Configuration configuration, std::shared_ptr<DriverConnection> scanner, const JobControl& control);
  Configuration for_another_scan(Configuration configuration) const;
  void open_session(const std::filesystem::path& folder, const JobControl& control);
  void adopt(HistoryEntry entry);
  void compare_what_is_shown();
  std::vector<std::string> write_results(OutputFolder& out, const JobControl& control);
  void show_next();
  static void remember_run(SessionSnapshot& snapshot);
  /// Fills what of a snapshot is the session's.
  void show_session(SessionSnapshot& snapshot) const;
  void show_map(SessionSnapshot next);
  void fill_map(SessionSnapshot& next);
  void show_refinement(SessionSnapshot& snapshot, const GibbsState& refinement);
  void show_next_view(SessionSnapshot& snapshot) const;
  void publish(SessionSnapshot snapshot);

  std::shared_ptr<Session> session_;
  std::unique_ptr<GibbsState> refinement_;  ///< the window's own; null if the planner has one, or none was asked for
  std::vector<std::shared_ptr<const Scan>> refined_scans_;  ///< that it holds
  std::shared_ptr<SeenSurface> seen_;                       ///< null without a session
  Configuration wanted_;  ///< of the last session that could not be made; while there is none
  ScanHistory history_;
  std::uint64_t change_when_gone_ = 0;         ///< the last one when the timeline was gone along
  std::shared_ptr<DriverConnection> scanner_;  ///< of the session, if it is a live one
  std::filesystem::path state_folder_;         ///< empty: sessions are not kept
  KeptSession::Notice notice_;
  std::shared_ptr<KeptSession> kept_;   ///< of the session; null without one
  std::shared_ptr<StepTree> tree_;      ///< likewise
  bool view_for_view_ = false;          ///< what is compared
  bool compares_later_ = false;         ///< what is seen is shown before it is compared with the truth
  bool sight_put_off_ = false;          ///< of the candidates (KnownObject::sight)
  std::vector<std::uint32_t> put_off_;  ///< steps of it whose maps and seen surface are to be made again
  std::shared_ptr<const SessionSnapshot> snapshot_ = std::make_shared<SessionSnapshot>();
};

}  // namespace nextview
