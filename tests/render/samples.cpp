#include "tests/render/samples.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/random/counter_random.hpp"
#include "core/view/candidate_views.hpp"
#include "core/view/pinhole_camera.hpp"

namespace nextview::samples {
namespace {

constexpr double ring = 0.17, tube = 0.08;  // radii of the torus [m]; its axis is y

/// Signed distance to the torus.
double distance(const Vector3& p) { return std::hypot(std::hypot(p.x(), p.z()) - ring, p.y()) - tube; }

Vector3 on_torus(double u, double v) {
  const double r = ring + tube * std::cos(v);
  return {r * std::cos(u), tube * std::sin(v), r * std::sin(u)};
}

Vector3 normal(double u, double v) { return {std::cos(v) * std::cos(u), std::sin(v), std::cos(v) * std::sin(u)}; }

/// Whether the way from `p` to `viewer` does not pass through the torus (by sphere tracing), beyond `start` [m].
bool visible(const Vector3& p, const Vector3& viewer, double start) {
  const Vector3 direction = (viewer - p).normalized();
  double t = start;
  while (t < (viewer - p).norm()) {
    const double d = distance(p + t * direction);
    if (d < 1e-3) return false;
    t += d;
  }
  return true;
}

/// Cosine between the torus' normal near `p` and the direction to the viewer.
double facing(const Vector3& p, const Vector3& viewer) {
  const Vector3 on_axis = Vector3(p.x(), 0, p.z()).normalized() * ring;
  return std::max(0.0, (p - on_axis).normalized().dot((viewer - p).normalized()));
}

PointCloud make_cloud(const Vector3& viewer) {
  const CounterRandom random(7, 900);
  PointCloud result;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    const auto [u, v, n, unused] = random.uniform(i);
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const Vector3 p = on_torus(a, b);
    if (normal(a, b).dot(viewer - p) > 0.1 && visible(p, viewer, 0.01)) {
      result.push_back((p + 0.002 * (n - 0.5) * normal(a, b)).cast<float>());
    }
  }
  return result;
}

Map make_map(const Vector3& viewer) {
  Map result{region_of_interest(Vector3::Zero(), 0.64, 0.01), {}};
  result.voxels.resize(result.grid.voxel_count());
  for (std::uint32_t i = 0; i < result.voxels.size(); ++i) {
    const Vector3 p = result.grid.centre(i);
    const double d = distance(p);
    if (d < -0.008 || !visible(p, viewer, 0.03)) continue;
    // Surfaces met at a steep angle are hit often; others are unsure; the way there is free.
    const double probability = d < 0.006 ? std::min(0.97, 0.55 + 0.6 * facing(p, viewer)) : 0.13;
    const auto voxel_class = InverseSensorModel{}.classify(probability);
    result.voxels[i] = {float(probability), float(entropy(probability)), voxel_class, true, 0};
  }
  return result;
}

/// Most pictures have the same viewer, and to trace its rays takes longer than to draw some of them. One store for each
/// type of what is made.
template <class Made>
const Made& made_once(const Vector3& viewer, Made (*make)(const Vector3&)) {
  static std::map<std::array<double, 3>, Made> made;
  const std::array<double, 3> key{viewer.x(), viewer.y(), viewer.z()};
  const auto found = made.find(key);
  return found != made.end() ? found->second : made.emplace(key, make(viewer)).first->second;
}

}  // namespace

TriangleMesh torus() {
  constexpr std::uint32_t around = 72, across = 36;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      mesh.vertices.push_back(
          on_torus(2 * std::numbers::pi * i / around, 2 * std::numbers::pi * j / across).cast<float>());
      const auto at = [](std::uint32_t a, std::uint32_t b) { return a % around * across + b % across; };
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

PointCloud cloud(const Vector3& viewer) { return made_once(viewer, make_cloud); }

Map map(const Vector3& viewer) { return made_once(viewer, make_map); }

std::vector<float> errors(const Map& map) {
  std::vector<float> result;
  for (std::uint32_t i = 0; i < map.voxels.size(); ++i) {
    const double d = distance(map.grid.centre(i)), truth = std::abs(d) < 0.0085 ? 1.0 : 0.0;
    const bool known = map.grid.centre(i).z() > -0.17;
    result.push_back(known ? float(std::abs(map.voxels[i].probability - truth)) : std::nanf(""));
  }
  return result;
}

std::vector<float> differences(const Map& map) {
  std::vector<float> result;
  for (std::uint32_t i = 0; i < map.voxels.size(); ++i) {
    const Vector3 p = map.grid.centre(i);
    const double d = distance(p), refined = 1 / (1 + std::exp((d - 0.0005) / 0.0015));
    const double settled = 0.5 + 0.5 * std::sin(14 * p.x() + 9 * p.z());  // not everywhere is there evidence
    result.push_back(d > 0.02 ? std::nanf("") : float(settled * (refined - map.voxels[i].probability)));
  }
  return result;
}

ScannedCloud scanned_cloud(const std::vector<Vector3>& viewers) {
  ScannedCloud result;
  for (std::size_t view = 0; view < viewers.size(); ++view) {
    const CounterRandom random(8 + view, 903);
    std::uint64_t i = 0;
    for (const Eigen::Vector3f& point : cloud(viewers[view])) {
      // Noise grows where the surface turns away, as a depth camera's does.
      const Vector3 p = point.cast<double>();
      const auto draw = random.uniform(i++);
      const double away = 1 - facing(p, viewers[view]);
      const Vector3 noisy = p + 0.03 * (draw[0] - 0.5) * away * away * (p - viewers[view]).normalized();
      result.points.push_back(noisy.cast<float>());
      result.views.push_back(std::uint16_t(view));
      result.distances.push_back(draw[1] < 0.01 ? std::nanf("") : float(std::abs(distance(noisy))));
    }
  }
  return result;
}

std::vector<std::uint8_t> seen_classes(const TriangleMesh& torus, const std::vector<Vector3>& viewers) {
  std::vector<std::uint8_t> result;
  for (const Eigen::Vector3f& vertex : torus.vertices) {
    const Vector3 p = vertex.cast<double>();
    bool seen = false;
    for (const Vector3& viewer : viewers) seen |= facing(p, viewer) > 0.1 && visible(p, viewer, 0.01);
    result.push_back(p.z() < -0.2 ? 2 : seen ? 0 : 1);
  }
  return result;
}

std::vector<Pose> candidates() {
  CandidateViewsConfig config;
  config.radius = 0.9;
  return candidate_views(config, Vector3::Zero());
}

std::vector<double> scores(const std::vector<Pose>& candidates, const Vector3& viewer) {
  std::vector<double> result;
  for (const Pose& pose : candidates) {
    const double away = 1 - pose.translation().normalized().dot(viewer.normalized());
    result.push_back(1000 * away * (1 + 0.2 * std::sin(5 * pose.translation().z())));
  }
  return result;
}

std::vector<RaySegment> rays(const Pose& pose) {
  const auto camera = PinholeCamera::from_field_of_view(640, 480, 58.0 * std::numbers::pi / 180);
  std::vector<RaySegment> result;
  for (int u = 176; u < 480; u += 32) {
    for (int v = 96; v < 400; v += 32) {
      const Vector3 direction = pose.linear() * camera.direction(u, v);
      for (int piece = 25; piece < 60; ++piece) {
        const Vector3 from = pose.translation() + 0.02 * piece * direction;
        const double d = distance(from);
        if (d < 0) break;
        result.push_back({from, from + 0.02 * direction, 0.69 * std::exp(-d / 0.05)});
      }
    }
  }
  return result;
}

}  // namespace nextview::samples
