#include "core/session/session.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"
#include "core/config/opened_input.hpp"
#include "core/memory/available_memory.hpp"
#include "core/planner/look_ahead_planner.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/recording_setup.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/shared_objects.hpp"
#include "core/session/start_map.hpp"
#include "core/source/inaccurate_source.hpp"

namespace nextview {

Session::Session(Configuration configuration, const Progress& progress, std::stop_token stop)
    : Session(std::move(configuration), SessionParts{}, progress, std::move(stop)) {}

Session::Session(Configuration configuration, SessionParts parts, const Progress& progress, std::stop_token stop) {
  Configuration& c = setup_.configuration = validated(std::move(configuration));
  if (!c.map.start.empty()) setup_.start_map = read_start_map(c);
  source_ = std::move(parts.source);
  name_ = std::move(parts.name);
  const bool map_alone = !source_ && c.recorded.folder.empty() && is_map(c.object.file);
  SharedObjects own;
  SharedObjects& objects = parts.objects ? *parts.objects : own;
  std::shared_ptr<const SimulatedWorld> world;
  if (!source_ && !c.recorded.folder.empty())
    world = replay(progress, stop);
  else if (map_alone)
    open_map();
  else if (!source_ || c.evaluation.enabled)
    world = simulate(objects, stop);
  else
    c = affordable(std::move(c));
  if (!setup_.start_map && !c.map.start.empty())
    setup_.start_map = read_start_map(c);  // that of a session gone through
  setup_.source = source_->describe();
  setup_.region = configured_region(c, setup_.source);
  choose_rays(setup_);
  robot_ = std::move(parts.robot);
  setup_.start =
      recording_ ? setup_.source.frames.at(start_frame(c, *recording_)) : start_view(c, setup_.source, robot_.get());
  robot_as_configured_ = !robot_;
  if (!robot_) robot_ = configured_robot(c, setup_.start);
  setup_.planner = std::move(parts.planner);
  if (!setup_.planner) setup_.planner = make_planner(c.planner);
  setup_.candidates = std::move(parts.candidates);
  if (map_alone) setup_.candidates = std::make_shared<FixedCandidates>(std::vector<View>{});
  views_as_configured_ = !setup_.candidates;
  if (!setup_.candidates) {
    const auto notice = [this](const std::string& text) { views_notes_.push_back(text); };
    setup_.candidates = configured_candidates(c, setup_.source, notice);
  }
  if (world && c.evaluation.enabled) compare_with(world, objects, progress, stop);
  ScanState nothing = nothing_scanned(setup_, robot_->pose());
  const auto voxels = double(nothing.known.map.voxels().size());
  setup_.start_entropy = setup_.start_map ? map_entropy(nothing.known.map.voxels()) : MapEntropy{voxels, voxels};
  if (map_alone) nothing.finished = "this is a map alone, and nothing can be scanned";
  adopt(std::move(nothing));
}

/// The object of the configuration, which becomes the source if there is no other.
std::shared_ptr<const SimulatedWorld> Session::simulate(SharedObjects& objects, const std::stop_token& stop) {
  Configuration& c = setup_.configuration;
  ConfiguredObject object = objects.load(c, stop);
  if (name_.empty()) name_ = object_name(object.file);
  object_file_ = std::move(object.file);
  object_ = std::move(object.placed);
  auto world = objects.world(object_, c.sensor, stop);
  if (!source_) source_ = std::make_unique<SimulatedSource>(world, c.seed);
  if (!c.robot.exact()) source_ = std::make_unique<InaccurateSource>(std::move(source_), c.robot, c.seed);
  return world;
}

/// The recording of the configuration. Returns the world that it was taken of, if that is known.
std::shared_ptr<const SimulatedWorld> Session::replay(const Progress& progress, const std::stop_token& stop) {
  Configuration& c = setup_.configuration;
  auto source = open_configured_recording(c, progress, stop);
  name_ = recording_name(c.recorded.folder);
  recording_ = &source->recording();
  source_ = std::move(source);
  setup_.recorded = recorded_surface(c, *recording_, progress, stop);
  if (c.recorded.truth.empty()) return nullptr;
  AlignedTruth truth = aligned_truth(c, setup_.recorded->samples(), stop);
  object_file_ = std::move(truth.file);
  object_ = std::move(truth.placed);
  truth_alignment_ = truth.alignment;
  return std::make_shared<const SimulatedWorld>(object_, c.sensor, stop);
}

/// A map of others, to be looked at.
void Session::open_map() {
  Configuration& c = setup_.configuration;
  name_ = std::filesystem::path(c.object.file).filename().string();
  Configuration with_map = c;
  with_map.map.start = with_map.fitted["map.start"] = c.object.file;
  setup_.start_map = read_start_map(with_map);
  c = affordable(validated(framed_by(*setup_.start_map, with_map)));
  Recording nothing;
  nothing.camera = c.sensor.camera();
  source_ = std::make_unique<RecordedSource>(std::move(nothing));
}

void Session::compare_with(const std::shared_ptr<const SimulatedWorld>& world, SharedObjects& objects,
                           const Progress& progress, const std::stop_token& stop) {
  const Configuration& c = setup_.configuration;
  const auto candidates = setup_.candidates->candidates(nothing_known(c, setup_.region, {}));
  setup_.truth = objects.known(world, c, setup_.region, poses_of(candidates), stop);
  if (c.evaluation.any_pose || c.views.layout == ViewLayout::adaptive)
    setup_.any_pose = setup_.truth->seen_from_any_pose(progress, stop);
}

void Session::recognise_fitted() {
  Configuration& c = setup_.configuration;
  if (recording_) {
    auto all = settings(c);
    for (const auto& [key, text] : recording_->follows)
      if (find_setting(all, key).text() == text) c.fitted[key] = text;
    return;
  }
  if (!object_) return;
  const Eigen::AlignedBox3d box = object_->mesh.bounding_box();
  c.fitted = lengths_as_fitted(c, box.sizes().maxCoeff());
  Configuration around = c;
  around.map.region.clear();
  fit_region(around, box);
  if (around.map.region == c.map.region) c.fitted = around.fitted;
}

std::shared_ptr<const TriangleMesh> Session::mesh() const {
  return object_ ? std::shared_ptr<const TriangleMesh>(object_, &object_->mesh) : nullptr;
}

std::vector<std::string> Session::notes() const {
  std::vector<std::string> notes;
  if (recording_) notes = recording_->guessed;
  if (object_ && object_->cloud_points > 0) notes.push_back(cloud_note(*object_));
  notes.insert(notes.end(), views_notes_.begin(), views_notes_.end());
  if (truth_alignment_)
    notes.push_back(
        alignment_note(*truth_alignment_, object_file_.filename().string(), setup_.recorded->samples(), object_->mesh));
  return notes;
}

/// One turn of Algorithm 2. Whatever ends it early, the state is as it was.
bool Session::step(const Progress& progress, std::stop_token stop, const Accept& accept) {
  if (!finished().empty()) throw std::logic_error("the scan is finished: " + finished());
  std::optional<ScanState> after;
  const auto put_back = [&] {
    if (!taken_) robot_->restored(state_.T_world_camera);
  };
  try {
    after = next_state(progress, stop, accept);
  } catch (const Stopped&) {
    taken_.reset();
  } catch (const std::bad_alloc&) {
    taken_.reset();
    put_back();
    throw OutOfMemory(not_enough_memory(configuration()));
  } catch (...) {
    put_back();
    throw;
  }
  if (!after) {
    put_back();
    return false;
  }
  taken_.reset();
  adopt(*std::move(after));
  if (!finished().empty() && state_.known.posterior) state_.known.posterior->forget_lists();
  if (progress) progress(1.0, "done");
  return true;
}

bool Session::step_again(const NextView& choice, Acquired acquired, const Progress& progress, std::stop_token stop) {
  state_.next = choice;
  if (choice.gain_unit.empty() && (choice.candidate || choice.is_custom))
    state_.next.gain_unit = setup_.planner->unit();
  state_.finished.clear();
  robot_->restored(acquired.reached);
  taken_ = std::move(acquired);
  return step(progress, std::move(stop));
}

/// None if it was cancelled or refused.
std::optional<ScanState> Session::next_state(const Progress& progress, const std::stop_token& stop,
                                             const Accept& accept) {
  if (taken_ && !(taken_->wanted == state_.next.view)) taken_.reset();  // another one is wanted by now
  if (!taken_ && !take_view(progress, stop, accept)) return std::nullopt;
  return plan(setup_, absorb(setup_, state_, *taken_, progress, stop), *robot_, taken_->reach, progress, stop);
}

/// False if it was cancelled or refused.
bool Session::take_view(const Progress& progress, const std::stop_token& stop, const Accept& accept) {
  const auto step = static_cast<std::uint32_t>(state_.scans.size() + 1);
  Result<Acquired> result = acquire(state_.next.view, step, *source_, *robot_, progress, stop);
  if (const auto* failure = std::get_if<Failure>(&result)) {
    if (failure->kind == Failure::cancelled || failure->kind == Failure::refused) return false;
    throw std::runtime_error(failure->reason);
  }
  Acquired& acquired = std::get<Acquired>(result);
  register_capture(setup_, state_, registration_target_, acquired, stop);
  const Verdict wanted = verdict(acquired);
  if (wanted == Verdict::reject) return false;
  if (wanted == Verdict::correct) correct(acquired);
  if (accept && !accept(acquired)) return false;
  taken_ = std::move(acquired);
  return true;
}

/// @throws std::runtime_error with the reason where it is rejected and no one is there to be asked
Session::Verdict Session::verdict(const Acquired& acquired) const {
  const RegistrationConfig& config = configuration().registration;
  const Verdict within = config.mode == RegistrationConfig::Mode::correct ? Verdict::correct : Verdict::accept;
  const std::string reason = beyond_limits(setup_, acquired);
  if (reason.empty()) return within;
  if (config.beyond_limits == RegistrationConfig::Beyond::accept) return within;
  if (config.beyond_limits == RegistrationConfig::Beyond::ask && judge_) return judge_(acquired, reason);
  const char* const way_out = within == Verdict::correct
                                  ? "registration.max_shift and registration.max_rotation allow more"
                                  : "registration.mode correct moves such scans";
  throw ScanRejected(
      fmt::format("the scan is rejected: {}; {}, registration.beyond_limits accept takes them", reason, way_out));
}

}  // namespace nextview
