#include "core/evaluation/known_object.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "core/evaluation/any_pose.hpp"
#include "core/evaluation/visited_voxels.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

std::vector<Eigen::Vector3f> sample_normals(const TriangleMesh& mesh, const SurfaceSamples& samples) {
  std::vector<Eigen::Vector3f> normals;
  for (const std::uint32_t t : samples.triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    normals.push_back((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized());
  }
  return normals;
}

std::vector<std::uint32_t> numbers_to(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

}  // namespace

KnownObject::KnownObject(const TriangleMesh& seen, SurfaceSamples samples, std::shared_ptr<const MeshRayCaster> scene,
                         const DepthCamera& camera, std::vector<Pose> candidates, const VoxelGrid& grid, double d_reg,
                         const std::stop_token& stop)
    : scene_(std::move(scene)),
      camera_(camera),
      samples_(std::move(samples)),
      normals_(sample_normals(seen, samples_)),
      all_samples_(numbers_to(samples_.points.size())),
      candidates_(std::move(candidates)),
      truth_(ground_truth(seen, grid, stop)),
      nothing_seen_{std::vector<std::uint8_t>(samples_.points.size()),
                    {samples_.points, d_reg},
                    {samples_.points, paper_d_reg},
                    BitMask(grid.voxel_count())} {
  throw_if_stopped(stop);
}

const CandidateSight& KnownObject::sight(const Progress& progress, const std::stop_token& stop) const {
  const std::lock_guard lock(finding_);
  if (!sight_) {
    // Isolated: while it waits, this thread must not take up work that asks for the same.
    sight_ = tbb::this_task_arena::isolate([&] { return sight_of(candidates_, progress, stop); });
    visible_ = sight_->seen_by_any();
  }
  return *sight_;
}

std::span<const std::uint8_t> KnownObject::visible(const std::stop_token& stop) const {
  sight({}, stop);
  return visible_;
}

CandidateSight KnownObject::sight_of(std::span<const Pose> candidates, const Progress& progress,
                                     const std::stop_token& stop) const {
  CandidateSight sight{{candidates.begin(), candidates.end()}, {}, samples_.points.size()};
  sight.samples.resize(candidates.size());
  std::atomic<std::size_t> done = 0;
  const std::thread::id here = std::this_thread::get_id();
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    sight.samples[v] = samples_seen(candidates[v], stop);
    const std::size_t so_far = ++done;  // of all threads; one tells of them, so that it never goes back
    if (progress && std::this_thread::get_id() == here)
      progress(double(so_far) / double(candidates.size()), "finding what each candidate can see");
  });
  throw_if_stopped(stop);
  return sight;
}

std::vector<std::uint32_t> KnownObject::samples_seen(const Pose& T_world_camera, const std::stop_token& stop) const {
  return nextview::visible_samples(surface(), *scene_, camera_, T_world_camera, all_samples_, any_slant, stop);
}

const std::vector<std::uint8_t>& KnownObject::seen_from_any_pose(const Progress& progress,
                                                                 const std::stop_token& stop) const {
  const std::lock_guard lock(finding_);
  if (!any_pose_)
    any_pose_ = tbb::this_task_arena::isolate([&] {  // as in sight()
      return nextview::seen_from_any_pose(surface(), *scene_, camera_, nothing_seen_.coverage.d_reg(), progress, stop);
    });
  return *any_pose_;
}

void KnownObject::add_view(EvaluationState& state, const Pose& T_world_camera, const PointCloud& points,
                           const std::stop_token& stop) const {
  const auto visit_voxels = [&] {
    const DepthImage ideal = camera_.sense_ideal(*scene_, T_world_camera, stop);
    const Scan scan = back_project(ideal, T_world_camera, camera_.config().max_range, stop);
    mark_visited(truth_.grid, scan, state.visited_voxels, stop);
  };
  const auto see_samples = [&] {
    std::vector<std::uint32_t> unseen;
    std::ranges::copy_if(all_samples_, std::back_inserter(unseen), [&](std::uint32_t s) { return !state.seen[s]; });
    for (const std::uint32_t s : visible_samples(surface(), *scene_, camera_, T_world_camera, unseen, any_slant, stop))
      state.seen[s] = 1;
  };
  // Side by side: each has parts that one thread does alone.
  tbb::parallel_invoke(
      visit_voxels, see_samples, [&] { state.coverage.add(points, stop); },
      [&] { state.coverage_paper.add(points, stop); });
}

}  // namespace nextview
