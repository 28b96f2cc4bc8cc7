#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "core/config/gibbs_config.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/planner/planner_config.hpp"
#include "core/planner/termination.hpp"
#include "core/registration/registration_config.hpp"
#include "core/robot/pose_error.hpp"
#include "core/sensor/depth_camera.hpp"
#include "core/setting/setting.hpp"
#include "core/setting/setting_sources.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {

struct ObjectConfig {
  std::string file;                         ///< mesh or cloud file; empty: the default object
  double longest_side = 0.0;                ///< the mesh is scaled to this [m]; 0 keeps its size
  LengthUnit unit = LengthUnit::automatic;  ///< of its file's coordinates, where it keeps its size
  UpAxis up = UpAxis::automatic;            ///< of its file's coordinates; of a cloud's, too
  bool centred = true;  ///< its bounding box is centred in the origin; else it stays where its file has it
  bool ground = false;  ///< it stands on a plane that the camera sees and that no coverage counts
};

/// Scans that were taken elsewhere, in the place of a simulated camera's (core/recording).
struct RecordedConfig {
  std::string folder;                    ///< or the file that holds them; empty: there are none
  std::string truth;                     ///< mesh of what was scanned, which is aligned with it; empty: none is known
  std::string start;                     ///< name or number of the frame to begin with; empty: the first
  int every = 1;                         ///< takes each n-th frame
  double stand_off = default_stand_off;  ///< of the scanner that took Stanford's range images, which do not tell [m]
};

/// A live scanner (core/driver). Its command is no setting: no file may start a program.
struct DriverConfig {
  std::string name;            ///< of the scanner that took a scan, which no simulation can repeat; empty: none did
  double timeout = 30.0;       ///< of each request [s]; 0: for ever where something is moved or captured
  std::string hand_eye;        ///< T_flange_camera, `x y z qx qy qz qw`, where the driver's poses are the flange's
  std::string working_volume;  ///< that the camera must not leave, `x y z x y z` of its corners [m, world]; empty: any

  /// None where any place will do. @throws std::invalid_argument if it is no box
  std::optional<Eigen::AlignedBox3d> volume() const;
  /// @throws std::invalid_argument if it is no pose
  Pose T_flange_camera() const;
};

struct MapConfig {
  double resolution = 0.01;         ///< voxel edge [m]
  double region_edge = 1.28;        ///< edge of the region of interest, a cube around the origin [m]
  std::string start;                ///< octree (.ot, .bt) to begin with; empty: nothing is known
  bool remove_planes = true;        ///< ground, table and walls are no part of an object that is looked for
  std::string region;               ///< region of interest, `x y z x y z` of its corners [m, world]; empty: that cube
  double occlusion_distance = 0.3;  ///< how far behind a surface voxels are marked [m]
  Insertion insertion = Insertion::direct;
  InverseSensorModel model;

  /// The region of interest [m, world]. @throws std::invalid_argument if `region` is none
  Eigen::AlignedBox3d region_box() const;
};
std::vector<Setting> settings(MapConfig& config);

/// What coverage is a share of.
enum class EvaluationSamples {
  surface,  ///< points spread over the surface in proportion to area
  vertices  ///< the mesh's vertices, each place counted once
};

struct EvaluationConfig {
  bool enabled = true;   ///< compare with the mesh after each view
  double d_reg = 0.005;  ///< registration distance of surface coverage [m]; the paper's 0.0005 is always reported too
  EvaluationSamples samples = EvaluationSamples::surface;
  int surface_samples = 50'000;
  bool any_pose = false;  ///< coverage of what any pose could see too; always so with adaptive views

  bool operator==(const EvaluationConfig&) const = default;
};

/// What the window keeps to go back to. It decides nothing of a scan.
struct HistoryConfig {
  double memory = 1.0;  ///< that the maps of earlier views may take [GiB]; older ones are made again from the scans
};

/// Everything that decides what a scan does: the same configuration gives the same bytes.
struct Configuration {
  std::uint64_t seed = 1;
  ObjectConfig object;
  RecordedConfig recorded;
  DriverConfig driver;
  RobotConfig robot;
  RegistrationConfig registration;
  std::string sensor_preset = "paper";
  DepthCameraConfig sensor;
  CloudConfig cloud;
  MapConfig map;
  GibbsConfig gibbs;
  CandidateViewsConfig views;
  PlannerConfig planner;
  TerminationConfig termination;
  EvaluationConfig evaluation;
  HistoryConfig history;
  std::vector<std::filesystem::path> read_from;  ///< the files it comes from, no setting: nothing may replace them
  SettingSources sources;                        ///< of settings that were given, for messages; no setting either
  std::map<std::string, std::string> fitted;     ///< lengths that follow the object's size (fit_lengths), as they do

  /// @throws std::invalid_argument naming the settings as they were given, and their bounds.
  void validate() const;
  /// A message that names settings by their keys, as they were given; what was changed since is left as it is.
  std::string as_given(const std::string& message) const;
};

/// The sampler's configuration for this camera and map.
PosteriorSamplerConfig posterior_sampler_config(const Configuration& configuration);

/// All settings of `configuration`, which must outlive them, in the order of a file.
std::vector<Setting> settings(Configuration& configuration);

/// Sets a setting and notes where it was given (SettingSource). The preset of the sensor sets all settings of it.
/// @throws std::invalid_argument, and for files std::runtime_error, as given
void give(Configuration& configuration, const std::string& key, const std::string& text, const std::string& name,
          const std::string& place = "");

/// Reads TOML, or what a picture (PNG) carries of it, over `configuration`: keys that the file leaves out stay as they
/// are; an unknown key is an error that names the nearest known one. Relative paths in it are relative to its folder;
/// what is not there, to the working folder. The caller validates what becomes of it.
/// @throws std::runtime_error "file:line: reason".
void read_settings(const std::filesystem::path& file, Configuration& configuration);
/// read_settings and Configuration::validate. @throws std::runtime_error, std::invalid_argument
Configuration read_configuration(const std::filesystem::path& file, const Configuration& base = Configuration());
std::string to_toml(const Configuration& configuration);
/// As a file in `folder` says it, so that it can be read from anywhere: a path is relative to the folder if its target
/// lies inside, absolute otherwise.
std::string to_toml(const Configuration& configuration, const std::filesystem::path& folder);

/// Sets the sensor to a preset: the name of a file in assets/sensors, or a path.
/// @throws std::runtime_error
void apply_sensor_preset(Configuration& configuration, const std::string& preset);

/// Files that come with Nextview: where NEXTVIEW_ASSETS in the environment says, or as shared_folder finds them.
std::filesystem::path assets_folder();
/// The file of a sensor that comes with the program, if there is one of this name.
std::filesystem::path named_sensor(const std::string& preset);
/// The gearbox housing of Debian's occt-misc, or, where that is not installed, the slotted housing of assets/objects.
std::filesystem::path default_object();
/// What `object.file` means: the path of a file; else a name in assets/objects, with or without .ply; "bunny" and
/// "gearbox"; empty: the default.
/// @throws std::runtime_error if it is none of these.
std::filesystem::path resolve_object(const std::string& name);
/// The same of a configuration's object; the error tells where it was given.
std::filesystem::path resolve_object(const Configuration& configuration);

}  // namespace nextview
