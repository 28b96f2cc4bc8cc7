#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/mesh/mesh_file.hpp"
#include "core/registration/alignment.hpp"
#include "core/session/planning_config.hpp"
#include "core/session/scan_loop.hpp"
#include "core/source/recorded_source.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {

class SharedObjects;

/// A scan that lies too far off those before it was not taken (RegistrationConfig). Another view may do.
struct ScanRejected : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a session is made of. What is null is what the configuration says: a simulated camera that flies freely around
/// the object, its planner, its candidates.
struct SessionParts {
  std::unique_ptr<ScanSource> source = {};
  std::unique_ptr<Robot> robot = {};
  std::unique_ptr<Planner> planner = {};
  std::unique_ptr<CandidateGenerator> candidates = {};
  std::string name = {};  ///< for people; empty: the object's
  /// What it shares with other sessions of its object; null: nothing. Only while it is made.
  SharedObjects* objects = nullptr;
};

/// A scan of one object: Algorithm 2, step by step, with the robot and the source that it is taken with. Not safe to
/// use from two threads at once.
class Session {
 public:
  /// Asked between capture and absorption; false refuses the view, and nothing of it is kept.
  using Accept = std::function<bool(const Acquired&)>;
  /// What becomes of a scan that lies farther off those before it than the limits allow.
  enum class Verdict { accept, correct, reject };
  /// Asked where `registration.beyond_limits` says so, with the reason; without it, such scans are rejected.
  using Judge = std::function<Verdict(const Acquired&, const std::string& reason)>;
  void set_judge(Judge judge) { judge_ = std::move(judge); }

  /// Loads the object and prepares the truth.
  /// @throws std::invalid_argument, std::runtime_error for settings and files; OutOfMemory; Stopped
  explicit Session(Configuration configuration, const Progress& progress = {}, std::stop_token stop = {});
  /// With parts of its own. With a source that is not simulated the object is loaded for the evaluation alone.
  /// @throws as above
  Session(Configuration configuration, SessionParts parts, const Progress& progress = {}, std::stop_token stop = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes the next view and ranks the candidates for the one after. Returns false, with the state as it was, if a stop
  /// is requested before all of that is done or the view is refused; the state is as it was too where it throws. What
  /// was captured before it threw is not lost: the next step goes on with it.
  /// @throws OutOfMemory; std::runtime_error if the robot or the source fails @pre finished().empty()
  bool step(const Progress& progress = {}, std::stop_token stop = {}, const Accept& accept = {});

  /// Takes a view that was captured before, as it was chosen then: the world is not touched, and no limit keeps it from
  /// being taken. The same bytes as when it was taken first. @throws, returns as step()
  bool step_again(const NextView& choice, Acquired acquired, const Progress& progress = {}, std::stop_token stop = {});

  /// All that evolves; what step() leaves is another value, this one can be kept.
  const ScanState& state() const { return state_; }
  /// Goes on from a state of this session's, or of one of the same configuration. Nothing is captured; a simulated
  /// robot is put back, a real one stays where it is.
  void restore(ScanState state);
  /// The same of a state that another planner has ranked. @throws std::invalid_argument if it is not valid
  void restore(ScanState state, const PlanningConfig& planning);

  /// Makes a candidate the next view instead of the proposal. @throws std::invalid_argument if it is not available.
  void override_next_view(std::size_t candidate);
  /// Makes a custom view the next one. Its record has view -1, overridden, and the gain that explain()
  /// expects of it now (0 if it has none). @throws std::invalid_argument before the first step, if the pose is not
  /// finite and rigid (is_pose), or if the robot cannot reach it.
  void override_next_view(const Pose& T_world_camera);

  /// Leaves the choice of the next view to the planner again.
  void take_proposal();

  /// Ranks other candidates or by another planner from here on, and keeps the scan; where it needs other maps they are
  /// made again from the scans. Coverage stays a share of what the first candidates could see.
  /// @throws std::invalid_argument if it is not valid; std::runtime_error naming the file of views; Stopped. Then all
  /// is as it was.
  void set_planning(const PlanningConfig& config, const Progress& progress = {}, const std::stop_token& stop = {});
  /// The same of the planner alone.
  void set_planner(const PlannerConfig& config, const Progress& progress = {}, const std::stop_token& stop = {}) {
    set_planning({config, configuration().views, configuration().gibbs}, progress, stop);
  }
  PlanningConfig planning() const { return planning_of(configuration()); }

  /// What it scans with, with another planner or other candidates. @throws as set_planning
  ScanSetup setup_with(const PlanningConfig& config, const std::stop_token& stop = {}) const;

  /// Changes when the scan is done, and keeps all else; a finished scan may go on by it.
  /// @throws std::invalid_argument if it is not valid.
  void set_termination(const TerminationConfig& config);

  /// Why the scan is done; empty while it is not.
  const std::string& finished() const { return state_.finished; }

  /// Takes lengths for fitted (Configuration::fitted) that are what the object's size, or the recording, would give,
  /// though they were read from a file: what is opened next has its own. Without either nothing is.
  void recognise_fitted();

  const ScanSetup& setup() const { return setup_; }
  const Configuration& configuration() const { return setup_.configuration; }
  /// Of the mesh; empty if there is none.
  const std::filesystem::path& object_file() const { return object_file_; }
  /// What is scanned, for people: the name of an object, a recording, a map.
  const std::string& name() const { return name_; }
  /// The recording that it goes through, if it does; else null.
  const Recording* recording() const { return recording_; }
  /// Its robot is a driver's: what it says is not known without it.
  bool has_live_robot() const { return !robot_as_configured_; }
  /// How a recording lies on the mesh of what was scanned; none without.
  const std::optional<Alignment>& truth_alignment() const { return truth_alignment_; }
  /// What was guessed and found when the recording was opened, a line each, for people.
  std::vector<std::string> notes() const;
  /// The object, if one was loaded; else null.
  std::shared_ptr<const TriangleMesh> mesh() const;
  const PlacedMesh& object() const { return *object_; }                      ///< @pre mesh()
  const MeshTopology& object_topology() const { return object_->topology; }  ///< as its file has it. @pre mesh()
  const PinholeCamera& camera() const { return setup_.source.camera; }
  const Planner& planner() const { return *setup_.planner; }
  const OccupancyMap& map() const { return state_.known.map; }
  const GibbsState* refinement() const { return state_.known.posterior.get(); }  ///< null unless the gain needs it
  /// What views are planned on: the Gibbs map if there is one.
  const VoxelBricks& planning_voxels() const { return state_.known.planning_voxels(); }
  const std::vector<Pose>& candidates() const { return candidates_; }
  const std::vector<StepRecord>& records() const { return records_; }
  const std::vector<std::shared_ptr<const Scan>>& scans() const { return state_.scans; }  ///< one per step, cleaned
  const KnownObject* known_object() const { return setup_.truth.get(); }                  ///< null without evaluation
  const EvaluationState* evaluation() const { return state_.evaluation.get(); }           ///< likewise

  /// Where the next view is taken from. Before the first step this is the start view.
  Pose next_view() const { return state_.next.view.T_world_camera; }
  /// The candidate that this is; none if it is the start view, or a custom view.
  std::optional<std::size_t> next_candidate() const { return state_.next.candidate; }
  /// Whether it is a custom view.
  bool next_view_is_custom() const { return state_.next.is_custom; }
  /// Why a candidate has its score now. Nothing if no rays explain the planner's values.
  std::optional<ScoreExplanation> explain(std::size_t candidate) const { return explain(candidates().at(candidate)); }
  /// What any other view would score now, taken apart. @pre is_pose(T_world_camera)
  std::optional<ScoreExplanation> explain(const Pose& T_world_camera) const;

 private:
  std::optional<ScanState> next_state(const Progress& progress, const std::stop_token& stop, const Accept& accept);
  bool take_view(const Progress& progress, const std::stop_token& stop, const Accept& accept);
  Verdict verdict(const Acquired& acquired) const;
  std::shared_ptr<const SimulatedWorld> simulate(SharedObjects& objects, const std::stop_token& stop);
  std::shared_ptr<const SimulatedWorld> replay(const Progress& progress, const std::stop_token& stop);
  void open_map();
  void compare_with(const std::shared_ptr<const SimulatedWorld>& world, SharedObjects& objects,
                    const Progress& progress, const std::stop_token& stop);
  void adopt(ScanState state);
  void require_first_step() const;
  void follow_views(ScanSetup& setup, const std::stop_token& stop) const;
  std::string unreachable(const View& view) const;

  ScanSetup setup_;
  std::string name_;
  std::filesystem::path object_file_;
  std::shared_ptr<const PlacedMesh> object_;
  std::optional<Alignment> truth_alignment_;
  std::vector<std::string> views_notes_;  // what was passed over where views were read
  const Recording* recording_ = nullptr;  ///< of the source
  std::unique_ptr<ScanSource> source_;
  std::unique_ptr<Robot> robot_;
  bool views_as_configured_ = false, robot_as_configured_ = false;  // unless the parts had others
  Judge judge_;
  ScanState state_;
  RegistrationTarget registration_target_;  ///< of the scans so far
  std::optional<Acquired> taken_;           ///< captured, and not yet in the state: a step failed after that
  std::vector<StepRecord> records_;         ///< the state's; so are the next
  std::vector<Pose> candidates_;
};

}  // namespace nextview
