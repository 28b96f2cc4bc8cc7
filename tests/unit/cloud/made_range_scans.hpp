#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/file/atomic_file.hpp"
#include "core/view/pose.hpp"

/// Range scans of a known thing, laid out to the last header line as the Stanford 3D Scanning Repository has the
/// bunny's, whose licence keeps those out of here.
namespace nextview::made_range_scans {

struct Ball {
  Vector3 centre;
  double radius;  ///< [m]
};
/// The thing [m, world]: no rotation takes it to itself.
inline const std::array<Ball, 3> balls = {
    {{{0.0, 0.1, 0.0}, 0.05}, {{0.05, 0.14, 0.02}, 0.03}, {{-0.03, 0.05, 0.04}, 0.02}}};

/// One scan: p_scan = turn * (p_world - shift).
struct Placed {
  std::string name;
  Vector3 axis;
  double degrees;
  Vector3 shift;  ///< [m]
  Eigen::Matrix3d turn() const {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
  }
};
inline const std::array<Placed, 4> scans = {{{"front.ply", {0, 1, 0}, 0, {0, 0, 0}},
                                             {"side.ply", {0, 1, 0}, 90, {0.0002, -0.0004, 0.0001}},
                                             {"top.ply", {1, 0.2, -0.3}, 100, {-0.05, 0.13, 0.09}},
                                             {"back.ply", {0.1, 1, 0.2}, 170, {0.003, 0.002, -0.01}}}};

/// The greatest z of the thing above a pixel, in the scan's frame.
inline std::optional<double> height(const Placed& scan, double x, double y) {
  std::optional<double> highest;
  for (const Ball& ball : balls) {
    const Vector3 c = scan.turn() * (ball.centre - scan.shift);
    const double under = ball.radius * ball.radius - (x - c.x()) * (x - c.x()) - (y - c.y()) * (y - c.y());
    if (under > 0.0 && (!highest || c.z() + std::sqrt(under) > *highest)) highest = c.z() + std::sqrt(under);
  }
  return highest;
}

/// The points of a scan, row by row, and its file.
struct RangeImage {
  std::vector<Vector3> points;
  std::string ply;
};
inline RangeImage range_image(const Placed& scan) {
  constexpr int columns = 128, rows = 100;
  constexpr double pitch = 0.002;  // [m]
  RangeImage image;
  std::string points, grid;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = (column - columns / 2) * pitch, y = (row - rows / 2) * pitch + 0.05;
      const auto z = height(scan, x, y);
      grid += z ? fmt::format("1 {} \n", image.points.size()) : "0 \n";
      if (!z) continue;
      image.points.emplace_back(x, y, *z);
      points += fmt::format("{:.6g} {:.6g} {:.6g} \n", x, y, *z);
    }
  image.ply = fmt::format(
      "ply\nformat ascii 1.0\nobj_info is_cyberware_data 1\nobj_info is_mesh 0\nobj_info is_warped 0\n"
      "obj_info is_interlaced 1\nobj_info num_cols {}\nobj_info num_rows {}\nobj_info echo_rgb_offset_x 0.013000\n"
      "obj_info echo_rgb_offset_y 0.153600\nobj_info echo_rgb_offset_z 0.172000\nobj_info echo_rgb_frontfocus "
      "0.930000\n"
      "obj_info echo_rgb_backfocus 0.012660\nobj_info echo_rgb_pixelsize 0.000010\nobj_info echo_rgb_centerpixel 232\n"
      "obj_info echo_frames 512\nobj_info echo_lgincr 0.000500\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement range_grid {}\nproperty list uchar int vertex_indices\nend_header\n{}{}",
      columns, rows, image.points.size(), columns * rows, points, grid);
  return image;
}

/// Writes thing.conf and the scans; `compress(file, bytes)` writes NAME.ply.gz, without it NAME.ply is written.
template <class Compress = std::nullptr_t>
void write(const std::filesystem::path& folder, Compress compress = nullptr) {
  std::string conf = "camera -0.0172 -0.0936 -0.734  -0.0461723 0.970603 -0.235889 0.0124573\n";
  for (const Placed& scan : scans) {
    const double half = 0.5 * scan.degrees * std::numbers::pi / 180;
    const Vector3 q = std::sin(half) * scan.axis.normalized(), t = scan.shift;
    conf += fmt::format("bmesh {} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", scan.name, t.x(), t.y(), t.z(),
                        q.x(), q.y(), q.z(), std::cos(half));
    if constexpr (std::is_null_pointer_v<Compress>)
      write_file(folder / scan.name, range_image(scan).ply);
    else
      compress(folder / (scan.name + ".gz"), range_image(scan).ply);
  }
  write_file(folder / "thing.conf", conf + "\n");
}

/// How far a point lies from the thing's surface [m, world].
inline double distance_to_thing(const Vector3& point) {
  double least = 1e9;
  for (const Ball& ball : balls) least = std::min(least, std::abs((point - ball.centre).norm() - ball.radius));
  return least;
}

}  // namespace nextview::made_range_scans
