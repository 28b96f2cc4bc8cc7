#pragma once
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "core/view/pose.hpp"

/// A folder as DTU's multi-view-stereo set lays objects out: a cloud, and cameras as 3 x 4 projection matrices; in mm.
namespace nextview::made_projections {

constexpr double radius = 60.0;  ///< of the sphere that the cloud is of [mm]
constexpr int cameras = 12;
inline const Vector3 middle(10.0, -20.0, 600.0);  ///< of the sphere [mm]

/// [mm]
inline Pose camera(int i) {
  const double azimuth = i * 2.0 * std::numbers::pi / cameras, elevation = (i % 3 - 1) * 0.6;
  return look_at(middle + 180.0 * Vector3(std::cos(elevation) * std::cos(azimuth),
                                          std::cos(elevation) * std::sin(azimuth), std::sin(elevation)),
                 middle);
}

/// Points x y z nx ny nz red green blue, off by noise [mm].
inline void write_cloud(const std::filesystem::path& file, int count, double noise) {
  std::ofstream out(file);
  out << "ply\nformat ascii 1.0\nelement vertex " << count;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "\nproperty float " << name;
  for (const char* name : {"red", "green", "blue"}) out << "\nproperty uchar " << name;
  out << "\nend_header\n";
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i) {
    const Vector3 n = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 p = middle + (radius + noise * normal(random)) * n;
    out << fmt::format("{:.4f} {:.4f} {:.4f} {:.3f} {:.3f} {:.3f} 200 180 160\n", p.x(), p.y(), p.z(), n.x(), n.y(),
                       n.z());
  }
}

/// pos_001.txt … of images of 1600 x 1200 pixels; and a file that is none of them.
inline void write_cameras(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Eigen::Matrix3d k;
  k << 2892.33, 0.0, 823.2, 0.0, 2883.18, 619.07, 0.0, 0.0, 1.0;
  for (int i = 0; i < cameras; ++i) {
    const Eigen::Matrix<double, 3, 4> p = k * camera(i).inverse().matrix().topRows<3>();
    std::ofstream out(folder / fmt::format("pos_{:03}.txt", i + 1));
    for (int r = 0; r < 3; ++r)
      out << fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} \n", p(r, 0), p(r, 1), p(r, 2), p(r, 3));
  }
  std::ofstream(folder / "readme.txt") << "Calibration\n";
}

}  // namespace nextview::made_projections
