#include "core/cloud/range_scan_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/cloud/point_cloud.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/inner_path.hpp"
#include "core/setting/rounded.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct ConfLine {
  std::string name;  ///< FILE.ply
  Pose T_world_scan = Pose::Identity();
};

/// False for pipes too, which would be waited for without end.
bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

fs::path find_conf(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".conf" && is_file(entry->path())) names.push_back(entry->path().filename());
  if (error) throw std::runtime_error(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (names.size() == 1) return folder / names.front();
  if (names.empty())
    throw std::runtime_error(
        fmt::format("{}: holds neither a finished scan nor range scans, which a .conf file places", folder.string()));
  std::sort(names.begin(), names.end());
  throw std::runtime_error(fmt::format("{}: has {} .conf files, where one is expected: {}", folder.string(),
                                       names.size(), fmt::join(names, ", ")));
}

std::vector<ConfLine> read_conf(const fs::path& file) {
  constexpr std::uintmax_t largest_conf = 1 << 20;
  std::istringstream text(read_file(file, largest_conf));
  std::vector<ConfLine> scans;
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    std::istringstream words(line);
    std::string keyword;
    if (!(words >> keyword) || keyword != "bmesh") continue;
    ConfLine scan;
    Eigen::Matrix<double, 7, 1> v;
    words >> scan.name;
    for (double& value : v) words >> value;
    if (!words || !(words >> std::ws).eof())
      throw std::runtime_error(
          fmt::format("{}:{}: expected `bmesh FILE.ply tx ty tz qx qy qz qw`", file.string(), number));
    if (const char* const why = why_not_within(scan.name))
      throw std::runtime_error(fmt::format("{}:{}: '{}' {}", file.string(), number, scan.name, why));
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(std::abs(q.norm() - 1.0) <= 1e-3))
      throw std::runtime_error(fmt::format("{}:{}: the quaternion (qx qy qz qw) has length {:.6g}; it must be 1",
                                           file.string(), number, q.norm()));
    scan.T_world_scan = make_pose(v.head<3>(), q.conjugate());  // the repository's q turns the other way
    scans.push_back(scan);
  }
  if (scans.empty()) throw std::runtime_error(fmt::format("{}: has no line `bmesh`", file.string()));
  return scans;
}

/// The scans' files, one per line of the .conf, plain or compressed.
std::vector<fs::path> find_scans(const fs::path& folder, const std::vector<ConfLine>& lines) {
  std::vector<fs::path> files;
  std::vector<std::string> missing;
  for (const ConfLine& line : lines) {
    files.push_back(folder / line.name);
    if (is_file(files.back())) continue;
    files.back() += ".gz";
    if (!is_file(files.back())) missing.push_back(line.name);
  }
  if (missing.empty()) return files;
  throw std::runtime_error(
      fmt::format("{}: scans are missing, plain and as .gz: {}", folder.string(), fmt::join(missing, ", ")));
}

/// The scans whose headers have lines that are not known.
struct UnknownLines {
  std::size_t files = 0;
  std::string first_file, first_line;

  void add(const fs::path& file, const std::string& line) {
    if (files++ > 0) return;
    first_file = file.filename().string();
    for (const char c : line.substr(0, 60)) first_line += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  }
  std::string text() const {
    return fmt::format(
        "{} of its scans {} header lines that are not known; they are read on over: the first is '{}' in {}", files,
        files == 1 ? "has" : "have", first_line, first_file);
  }
};

/// `points`: of at least one.
RecordedScan before_a_camera(const PointCloud& points, const Pose& T_world_scan, double stand_off) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double greatest_z = points.front().z();
  for (const Eigen::Vector3f& p : points) {
    sum += p.head<2>().cast<double>();
    greatest_z = std::max<double>(greatest_z, p.z());
  }
  Pose T_scan_camera = Pose::Identity();
  T_scan_camera.linear().diagonal() << 1.0, -1.0, -1.0;  // the scan's y is up and it is looked at along -z
  T_scan_camera.translation() << sum / static_cast<double>(points.size()), greatest_z + stand_off;

  RecordedScan scan;
  scan.T_world_camera = T_world_scan * T_scan_camera;
  const Pose T_camera_scan = T_scan_camera.inverse();
  scan.points.reserve(points.size());
  for (const Eigen::Vector3f& p : points) scan.points.push_back(T_camera_scan * p.cast<double>());
  return scan;
}

Eigen::AlignedBox3d bounding_box(const std::vector<RecordedScan>& scans) {
  Eigen::AlignedBox3d box;
  for (const RecordedScan& scan : scans)
    for (const Vector3& p : scan.points) box.extend(scan.T_world_camera * p);
  return box;
}

/// With a margin all around, its faces between voxels.
Eigen::AlignedBox3d region_around(const Eigen::AlignedBox3d& points, double resolution) {
  const double margin = 0.1 * points.sizes().maxCoeff();
  return {((points.min().array() - margin) / resolution).floor() * resolution,
          ((points.max().array() + margin) / resolution).ceil() * resolution};
}

double farthest_range(const std::vector<RecordedScan>& scans) {
  double farthest = 0.0;
  for (const RecordedScan& scan : scans)
    for (const Vector3& p : scan.points) farthest = std::max(farthest, p.norm());
  return farthest;
}

/// Adds what a scene needs beyond its scans to be mapped and scored.
void add_parameters_and_views(RecordedScene& scene, const Eigen::AlignedBox3d& points, double resolution) {
  const Eigen::AlignedBox3d region = region_around(points, resolution);
  CandidateViewsConfig views;
  views.count = 48;
  views.radius = 1.8 * region.sizes().maxCoeff();
  scene.views = candidate_views(views, region.center());
  scene.parameters["resolution_m"] = resolution;
  scene.parameters["max_sensor_range_m"] = 1.01 * farthest_range(scene.scans);
  scene.parameters["max_ray_depth_m"] = views.radius + 0.5 * region.diagonal().norm();
  for (const int axis : {0, 1, 2}) {
    scene.parameters[fmt::format("bbox_min_{}_m", "xyz"[axis])] = region.min()[axis];
    scene.parameters[fmt::format("bbox_max_{}_m", "xyz"[axis])] = region.max()[axis];
  }
}

}  // namespace

RecordedScene read_range_scan_folder(const fs::path& folder, double stand_off, double resolution,
                                     const std::function<void(const std::string&)>& notice, double unit) {
  const auto require = [](const char* name, double value, const Bounds& bounds) {
    if (!bounds.allow(value))
      throw std::invalid_argument(fmt::format("range scans: {} must be {}, not {} m", name, bounds.text("m"), value));
  };
  require("stand_off", stand_off, stand_off_bounds);
  require("resolution", resolution, range_scan_voxel_bounds);
  const std::vector<ConfLine> lines = read_conf(find_conf(folder));
  const std::vector<fs::path> files = find_scans(folder, lines);
  RecordedScene scene;
  UnknownLines unknown;
  for (std::size_t i = 0; i < files.size(); ++i) {
    PointCloud points = read_ply(files[i], [&](const std::string& line) { unknown.add(files[i], line); });
    if (points.empty()) throw std::runtime_error(fmt::format("{}: holds no points", files[i].string()));
    for (Eigen::Vector3f& point : points) point *= static_cast<float>(unit);
    Pose T_world_scan = lines[i].T_world_scan;
    T_world_scan.translation() *= unit;
    scene.scans.push_back(before_a_camera(points, T_world_scan, stand_off));
  }
  if (notice && unknown.files > 0) notice(unknown.text());
  const Eigen::AlignedBox3d box = bounding_box(scene.scans);
  const double longest = box.sizes().maxCoeff();
  if (!(longest >= 0.01 && longest <= 40.0))
    throw std::runtime_error(fmt::format(
        "{}: its points span {:.3g} m; from 0.01 to 40 m are taken (is it in metres? dataset.toml has a unit)",
        folder.string(), longest));
  add_parameters_and_views(scene, box, resolution > 0.0 ? resolution : rounded(0.01 * longest, 1));
  return scene;
}

}  // namespace nextview
