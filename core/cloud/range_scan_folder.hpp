#pragma once
#include <functional>

#include "core/sensor/recorded_scans.hpp"
#include "core/setting/bounds.hpp"

namespace nextview {

/// From the scanner to the nearest point of a scan, along the axis it looks along [m]. A guess: the range images do not
/// tell it.
inline constexpr double default_stand_off = 0.7;
inline constexpr Bounds stand_off_bounds = from_to(0.01, 100);       // [m]
inline constexpr Bounds range_scan_voxel_bounds = zero_or(1e-4, 1);  // [m]

/// Reads the range scans of a folder as the Stanford 3D Scanning Repository has them: one file `*.conf` with a line
/// `bmesh FILE.ply tx ty tz qx qy qz qw` a scan, and beside or below it each FILE.ply, or FILE.ply.gz. Other lines of
/// the .conf and all but the vertices are passed over, and so are lines of a scan's header that are not known: `notice`
/// hears of them, in one line for the folder. A point goes to the world by p_world = R(q)^T p_scan + t, in units of
/// `unit` [m].
///
/// The scanner sits on the +z side of a scan and looks along -z. Its camera is put at the mean x and y of the scan's
/// points, `stand_off` [m] beyond their greatest z; rays from there run nearly along those of the scanner, not exactly.
///
/// Parameters of the scene, by the names that read_recorded_scene knows: `resolution_m`, as given, or if 0 a hundredth
/// of the longest side of all points' bounding box, rounded to one significant digit; `bbox_min_x_m` to `bbox_max_z_m`,
/// that box and a tenth of its longest side around it, snapped outwards to the resolution; `max_sensor_range_m`, 1 %
/// beyond the farthest point; `max_ray_depth_m`, from a view to behind the box. Views: 48 on a sphere around the box's
/// centre, its radius 1.8 times the box's longest side.
/// @throws std::invalid_argument if `stand_off` or `resolution` is out of its bounds.
/// @throws std::runtime_error with one line that names the folder or file and the reason: none or several .conf, a line
///         that is wrong, missing or unreadable scans, scans without points, points that span less than 1 cm or over
///         40 m (other units?).
RecordedScene read_range_scan_folder(const std::filesystem::path& folder, double stand_off = default_stand_off,
                                     double resolution = 0.0,
                                     const std::function<void(const std::string&)>& notice = {}, double unit = 1.0);

}  // namespace nextview
