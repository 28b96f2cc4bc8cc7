#include "core/evaluation/any_pose.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/progress/stopped.hpp"
#include "core/random/counter_random.hpp"
#include "core/random/on_sphere.hpp"

namespace nextview {
namespace {

constexpr std::uint64_t seed = 1;          // whatever a scan's is: all scans are compared by the same
constexpr std::size_t directions = 128;    // that are tried of each side of a sample
constexpr std::size_t poses_at_once = 20;  // all of them before what they saw counts as seen

class Poses {
 public:
  Poses(const SampledSurface& surface, const MeshRayCaster& scene, const DepthCamera& camera, double d_reg)
      : surface_(surface), scene_(scene), camera_(camera), d_reg_(d_reg) {}

  /// A pose that looks at the sample; none if no direction was found in which it lies open.
  std::optional<Pose> looking_at(std::uint32_t sample, std::uint64_t number) const {
    const CounterRandom random(seed, random_stream::any_pose, static_cast<std::uint32_t>(number));
    for (const bool is_front : {true, false})
      for (const Eigen::Vector3f& direction : open_directions(sample, is_front, random))
        if (auto pose = in_direction(sample, direction, random.uniform(0)[1])) return pose;
    return std::nullopt;
  }

 private:
  std::vector<Eigen::Vector3f> open_directions(std::uint32_t sample, bool is_front, const CounterRandom& random) const {
    const Eigen::Vector3f normal = (is_front ? 1.0f : -1.0f) * surface_.normals[sample];
    std::vector<Eigen::Vector3f> drawn(directions);
    for (std::size_t i = 0; i < directions; ++i) {
      const auto u = random.uniform(1 + i + (is_front ? 0 : directions));
      drawn[i] = on_sphere(u[0], u[1]).cast<float>();
      if (drawn[i].dot(normal) < 0.0f) drawn[i] = -drawn[i];
    }
    const auto off_surface = static_cast<float>(std::min(5e-4, 0.1 * d_reg_));  // [m]
    std::vector<MeshRayCaster::Hit> hits(directions);
    scene_.cast((surface_.points[sample] + off_surface * normal).cast<double>(), drawn,
                std::numeric_limits<float>::max(), hits);
    std::vector<Eigen::Vector3f> open;
    for (std::size_t i = 0; i < directions; ++i)
      if (hits[i].range == DepthImage::beyond_range) open.push_back(drawn[i]);
    return open;
  }

  /// From a distance that is drawn, or farther where that is too near to something.
  std::optional<Pose> in_direction(std::uint32_t sample, const Eigen::Vector3f& direction, double share) const {
    const double cosine = std::abs(direction.dot(surface_.normals[sample]));
    const double nearest = camera_.config().min_range;
    const double farthest = std::min(camera_.config().max_range, resolved_range(camera_.camera(), cosine, d_reg_));
    if (farthest < nearest) return std::nullopt;
    constexpr int tries = 4;
    for (int i = 0; i < tries; ++i) {
      const double range = nearest + (farthest - nearest) * (share + (1.0 - share) * i / tries);
      const Vector3 target = surface_.points[sample].cast<double>();
      const Vector3 position = target + range * direction.cast<double>();
      if (is_clear(position.cast<float>())) return look_at(position, target);
    }
    return std::nullopt;
  }

  bool is_clear(const Eigen::Vector3f& position) const {
    const auto least = static_cast<float>(camera_.config().min_range);
    return std::ranges::none_of(surface_.points, [&](const Eigen::Vector3f& point) {
      return (point - position).squaredNorm() < 0.999f * least * least;
    });
  }

  const SampledSurface& surface_;
  const MeshRayCaster& scene_;
  const DepthCamera& camera_;
  double d_reg_;
};

}  // namespace

std::vector<std::uint8_t> seen_from_any_pose(const SampledSurface& surface, const MeshRayCaster& scene,
                                             const DepthCamera& camera, double d_reg, const Progress& progress,
                                             const std::stop_token& stop) {
  const Poses poses(surface, scene, camera, d_reg);
  const CounterRandom random(seed, random_stream::any_pose);
  std::vector<std::uint8_t> seen(surface.points.size());
  std::vector<std::uint32_t> unseen(surface.points.size());
  std::iota(unseen.begin(), unseen.end(), 0u);
  for (std::size_t first = 0; first < any_poses && !unseen.empty(); first += poses_at_once) {
    throw_if_stopped(stop);
    if (progress) progress(double(first) / any_poses, "finding what any pose could see");
    std::vector<std::vector<std::uint32_t>> seen_from(poses_at_once);
    tbb::parallel_for(std::size_t{0}, poses_at_once, [&](std::size_t i) {
      const std::uint64_t number = first + i + 1;  // 0 draws the samples
      const auto target = static_cast<std::size_t>(random.uniform(number)[0] * double(unseen.size()));
      if (const auto pose = poses.looking_at(unseen[target], number))
        seen_from[i] = visible_samples(surface, scene, camera, *pose, unseen, d_reg, stop);
    });
    for (const auto& samples : seen_from)
      for (const std::uint32_t s : samples) seen[s] = 1;
    std::erase_if(unseen, [&](std::uint32_t s) { return seen[s] != 0; });
  }
  return seen;
}

}  // namespace nextview
