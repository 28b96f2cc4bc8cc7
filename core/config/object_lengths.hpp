#pragma once
#include <span>

#include "core/config/configuration.hpp"

namespace nextview {

/// Sets the lengths that were not given to what suits an object of this size [m]: voxels of a fiftieth (of 1, 2 or
/// 5 x 10^k), the region of interest 2.56 times as large, views from 1.8 times as far off, and so on. Given is what
/// `sources` names, or what is neither as it is by default nor as it was fitted before; a sensor's lengths also where a
/// preset was given. With 0.5 m all is as it is by default.
void fit_lengths(Configuration& configuration, double longest_side);
/// Lays the region of interest, a cube of map.region_edge, around an object that stays where its file has it
/// (object.centred false), unless map.region was given.
void fit_region(Configuration& configuration, const Eigen::AlignedBox3d& object);
/// The lengths that are what fit_lengths would make of an object with this longest side [m], whoever set them: by key,
/// as Configuration::fitted.
std::map<std::string, std::string> lengths_as_fitted(const Configuration& configuration, double longest_side);

/// Whether a setting is what someone wants: not as it is by default, and not what follows from the object.
bool is_given(const Configuration& configuration, const std::string& key);
/// Sets a setting that follows from what is scanned, if it was not given.
void set_unless_given(Configuration& configuration, const std::string& key, const std::string& text);

/// Lets the rays that score a view get through the region of interest from each of these poses. @pre map.region is set
void lengthen_rays(Configuration& configuration, std::span<const Pose> T_world_cameras);

/// Sets a setting that what is scanned decides. Another value that was given is an error, not a wish.
/// @throws std::invalid_argument naming the setting as it was given, and its `owner`: "the recording"
void decide(Configuration& configuration, const std::string& key, const std::string& text, const std::string& owner);
/// The same of a camera's size and intrinsics.
void decide_camera(Configuration& configuration, const PinholeCamera& camera, const std::string& owner);

/// Settings that follow from what is scanned are as they are by default again.
void forget_fitted(Configuration& configuration);

/// Whether fit_lengths has not set this length yet, and will: what it is now means nothing.
bool awaits_object(const Configuration& configuration, const std::string& key);

/// The longest side of an object that comes with the program, where its file's own size means nothing [m]; else 0.
double declared_longest_side(const std::filesystem::path& file);

/// How load_mesh places the object of a configuration.
MeshFileOptions placement(const ObjectConfig& object, const std::filesystem::path& file);

/// "506 x 500.5 x 320.5 mm"
std::string size_text(const Eigen::AlignedBox3d& box);
/// Lengths that fit_lengths sets, as they are now: "voxels 10 mm, region 1.3 m, …".
std::string lengths_text(const Configuration& configuration);

}  // namespace nextview
