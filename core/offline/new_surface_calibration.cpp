#include "core/offline/new_surface_calibration.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <functional>
#include <stdexcept>

#include "core/calibration/slant_fit.hpp"
#include "core/evaluation/coverage.hpp"
#include "core/map/traversal.hpp"
#include "core/offline/training_parts.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/progress/stopped.hpp"
#include "core/random/counter_random.hpp"
#include "core/sensor/depth_image.hpp"
#include "core/session/session.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

/// What is met at more than 80 degrees from its normal is not seen well enough to count.
constexpr float least_cosine = 0.17f;

/// What the scoring rays of all candidate views meet, and whether any view has covered it yet.
class CandidateRays {
 public:
  CandidateRays(const SimulatedWorld& world, const ScanSetup& setup, std::span<const Pose> views)
      : setup_(setup), views_(views.begin(), views.end()), hits_(views.size() * setup.bundle.directions.size()) {
    const std::size_t count = rays();
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
      std::vector<Eigen::Vector3f> directions;
      for (std::size_t i = 0; i < count; ++i) directions.push_back(direction(v, i).cast<float>());
      world.scene.cast(views[v].translation(), directions, static_cast<float>(length()),
                       std::span(hits_).subspan(v * count, count));
    });
    PointCloud points;
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      point_of_.push_back(points.size());
      if (!DepthImage::is_beyond_range(hits_[i].range))
        points.push_back(
            (views[i / count].translation() + hits_[i].range * direction(i / count, i % count)).cast<float>());
    }
    if (points.empty()) throw std::invalid_argument("new surface: no candidate view sees the object");
    covered_.emplace(points, setup.configuration.evaluation.d_reg);
  }

  void cover(const PointCloud& points, const std::stop_token& stop) { covered_->add(points, stop); }

  /// The new surface that a candidate view would show [cm^2].
  double shown(std::size_t view) const {
    double area = 0.0;
    for (std::size_t number = view * rays(); number < (view + 1) * rays(); ++number) {
      if (!is_new(number)) continue;
      const double range = hits_[number].range;
      area += setup_.bundle.solid_angles[number % rays()] * range * range / double(hits_[number].cosine);
    }
    return square_centimetres_of_a_square_metre * area;
  }

  /// What the rays of one candidate view find in a map.
  NewSurfaceObservations observe(const SurfaceEvidence& evidence, std::size_t view) const {
    NewSurfaceObservations observations;
    for (std::size_t i = 0; i < rays(); ++i) observe(evidence, view, i, observations);
    return observations;
  }

 private:
  std::size_t rays() const { return setup_.bundle.directions.size(); }
  double length() const { return setup_.configuration.planner.ray_length; }
  Vector3 direction(std::size_t view, std::size_t ray) const {
    return views_[view].linear() * setup_.bundle.directions[ray];
  }

  bool is_new(std::size_t number) const {
    const MeshRayCaster::Hit& hit = hits_[number];
    return !DepthImage::is_beyond_range(hit.range) && hit.cosine >= least_cosine &&
           !covered_->observed()[point_of_[number]];
  }

  void observe(const SurfaceEvidence& evidence, std::size_t view, std::size_t ray, NewSurfaceObservations& to) const {
    using Kind = SurfaceEvidence::Kind;
    const VoxelGrid& grid = evidence.grid();
    const std::size_t number = view * rays() + ray;
    const MeshRayCaster::Hit& hit = hits_[number];
    const double range = hit.range;
    const Vector3 towards = direction(view, ray);
    const bool is_new = this->is_new(number);
    walk_ray_segments(grid, views_[view].translation(), towards, length(),
                      [&](int x, int y, int z, double enter, double exit) {
                        const Eigen::Vector3i voxel(x, y, z);
                        if (!evidence.may_hold_surface(voxel)) return enter <= range;
                        // An occupied voxel ends the planner's ray, though the surface may lie right behind it.
                        const bool ends = evidence.kind(voxel) == Kind::occupied;
                        if (enter > range + (ends ? 0.5 * grid.resolution : 0.0)) return false;
                        const double weight = setup_.bundle.solid_angles[ray] * enter * enter;
                        const bool found = is_new && (ends || exit > range);
                        to.add(evidence, voxel, weight, found);
                        if (found) to.add_slant(weight, 1.0 / double(hit.cosine));
                        return !ends && exit <= range;
                      });
  }

  const ScanSetup& setup_;
  std::vector<Pose> views_;
  std::vector<MeshRayCaster::Hit> hits_;  ///< of each ray of each view
  std::vector<std::size_t> point_of_;     ///< of a ray that hits: its number among those
  std::optional<SurfaceCoverage> covered_;
};

template <class T>
void choose(const std::vector<T>& choices, std::size_t number, T& value) {
  if (!choices.empty()) value = choices[number % choices.size()];
}

Configuration configuration_of(std::size_t object, Configuration c, const NewSurfaceCalibrationConfig& config) {
  const double ratio = double(c.sensor.height) / c.sensor.width;
  choose(config.resolutions, object, c.map.resolution);
  choose(config.widths, object, c.sensor.width);
  choose(config.range_noises, object, c.sensor.range_noise);
  c.sensor.height = std::max(1, static_cast<int>(std::lround(ratio * c.sensor.width)));
  c.planner.gain = "new-surface";
  // What all views would see is found out once: they must stay.
  if (c.views.layout == ViewLayout::adaptive) c.views.layout = ViewLayout::sphere;
  c.planner.start_azimuth = 360.0 * CounterRandom(c.seed, random_stream::training_views).uniform(object)[0];
  c.termination = {};
  c.termination.views = config.views;
  c.termination.surface_left = 0.0;
  c.evaluation.enabled = false;
  c.seed += object;
  return c;
}

/// Any candidate that is left.
void go_anywhere(Session& session, std::uint64_t seed) {
  const auto& candidates = session.records().back().candidates;
  std::vector<std::size_t> left;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) left.push_back(v);
  const double drawn = CounterRandom(seed, random_stream::training_views, 1).uniform(session.records().size())[0];
  if (!left.empty()) session.override_next_view(left[static_cast<std::size_t>(drawn * double(left.size()))]);
}

/// A scan after one of its views.
struct Moment {
  const TrainingObject& object;
  const Session& session;
  const CandidateRays& rays;
  std::vector<std::size_t> views;  ///< that are learned from: every other one that is left, as neighbours see the same
};

void scan(const TrainingObject& object, const Configuration& configuration, const std::stop_token& stop,
          const std::function<void(const Moment&)>& look) {
  const auto world = std::make_shared<const SimulatedWorld>(object.object, configuration.sensor, stop);
  SessionParts parts;
  parts.source = std::make_unique<SimulatedSource>(world, configuration.seed);
  Session session(configuration, std::move(parts), {}, stop);
  CandidateRays rays(*world, session.setup(), session.candidates());
  while (session.finished().empty()) {
    if (!session.step({}, stop)) throw Stopped();
    rays.cover(session.scans().back()->hits, stop);
    Moment now{object, session, rays, {}};
    for (std::size_t v = session.records().size() % 2; v < session.candidates().size(); v += 2)
      if (session.records().back().candidates[v].available) now.views.push_back(v);
    look(now);
    throw_if_stopped(stop);
    if (session.finished().empty() && session.records().size() % 2 == 0) go_anywhere(session, configuration.seed);
  }
}

/// What the rays of the views find.
NewSurfaceObservations found(const Moment& now, const std::stop_token& stop) {
  const SurfaceEvidence evidence = surface_evidence(now.session.state().known);
  std::vector<NewSurfaceObservations> of_view(now.views.size());
  tbb::parallel_for(std::size_t{0}, now.views.size(), [&](std::size_t i) {
    if (!stop.stop_requested()) of_view[i] = now.rays.observe(evidence, now.views[i]);
  });
  NewSurfaceObservations all;
  for (const NewSurfaceObservations& some : of_view) all.add(some);
  return all;
}

/// What the views show as a whole.
ShownByViews shown(const Moment& now) {
  ShownByViews shown{surface_evidence(now.session.state().known),
                     now.session.setup().bundle,
                     now.session.configuration().planner.ray_length,
                     square_centimetres_of_a_square_metre * now.object.object->mesh.surface_area(),
                     {},
                     {}};
  for (const std::size_t view : now.views) {
    shown.views.push_back(now.session.candidates()[view]);
    shown.areas.push_back(now.rays.shown(view));
  }
  return shown;
}

}  // namespace

std::vector<TrainingObject> training_objects(int count, std::uint64_t seed, std::stop_token stop) {
  std::vector<TrainingObject> objects(static_cast<std::size_t>(std::max(0, count)));
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    TriangleMesh mesh = training_part(static_cast<std::uint32_t>(i), seed);
    const MeshTopology topology_of_it = topology(mesh);
    objects[i] = {fmt::format("part {}", i),
                  std::make_shared<const PlacedMesh>(PlacedMesh{std::move(mesh), {}, topology_of_it})};
  });
  throw_if_stopped(stop);
  return objects;
}

NewSurfaceCalibration calibrate_new_surface(std::span<const TrainingObject> objects, const Configuration& configuration,
                                            const NewSurfaceCalibrationConfig& config, const Progress& progress,
                                            std::stop_token stop) {
  if (objects.empty()) throw std::invalid_argument("new surface: there is no object to learn from");
  NewSurfaceCalibration calibration;
  const auto scan_all = [&](double done, const std::function<void(const Moment&)>& look) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (progress) progress(done + 0.5 * double(i) / double(objects.size()), "scanning " + objects[i].name);
      scan(objects[i], configuration_of(i, configuration, config), stop, look);
    }
  };
  NewSurfaceObservations all;
  scan_all(0.0, [&](const Moment& now) { all.add(found(now, stop)); });
  calibration.model = all.fit();
  SlantFit slant(calibration.model);  // from the same scans again: to keep all their maps would take too much memory
  scan_all(0.5, [&](const Moment& now) { slant.add(shown(now)); });
  calibration.model.slant = slant.fit();
  for (const TrainingObject& object : objects) calibration.objects.push_back(object.name);
  using Kind = SurfaceEvidence::Kind;
  calibration.cells = all.cells();
  const double unmeasured = all.found(Kind::unmeasured), free = all.found(Kind::free),
               occupied = all.found(Kind::occupied), total = unmeasured + free + occupied;
  calibration.found_unmeasured = unmeasured / total;
  calibration.found_free = free / total;
  calibration.found_occupied = occupied / total;
  if (progress) progress(1.0, "done");
  return calibration;
}

}  // namespace nextview
