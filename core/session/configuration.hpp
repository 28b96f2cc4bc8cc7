#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/planner/planner_config.hpp"
#include "core/planner/termination.hpp"
#include "core/sensor/depth_camera.hpp"
#include "core/session/gibbs_config.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {

struct ObjectConfig {
  std::string file;           ///< mesh file; empty: the default object
  double longest_side = 0.5;  ///< the mesh is scaled to this [m]; 0 keeps its size
};

struct MapConfig {
  double resolution = 0.01;   ///< voxel edge [m]
  double region_edge = 1.28;  ///< edge of the region of interest, a cube around the object [m]
  Insertion insertion = Insertion::local_octree;
  InverseSensorModel model;
};

struct EvaluationConfig {
  bool enabled = true;   ///< compare with the mesh after each view
  double d_reg = 0.005;  ///< registration distance of surface coverage [m]; the paper's 0.0005 is always reported too
  int surface_samples = 50'000;
};

/// What the window keeps to go back to. It decides nothing of a scan.
struct HistoryConfig {
  double memory = 1.0;  ///< that the maps of earlier views may take [GiB]; older ones are made again from the scans
};

/// Everything that decides what a scan does: the same configuration gives the same bytes.
struct Configuration {
  std::uint64_t seed = 1;
  ObjectConfig object;
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

  /// @throws std::invalid_argument naming the field and its bounds.
  void validate() const;
};

/// The sampler's configuration for this camera and map.
PosteriorSamplerConfig posterior_sampler_config(const Configuration& configuration);

/// One setting of a configuration. Files, the command line, `--help` and panels are all made from the list of these.
struct Setting {
  struct Choice {
    std::vector<std::string> names;
    std::function<std::size_t()> get;
    std::function<void(std::size_t)> set;
  };
  std::string key;   ///< as in the file and, behind `--`, on the command line: "sensor.range_noise"
  std::string unit;  ///< "m", "deg", …; empty if it has none
  std::string help;
  std::variant<bool*, int*, double*, std::uint64_t*, std::string*, Choice> value;

  std::string text() const;
  /// @throws std::invalid_argument naming the key and what it takes.
  void set(const std::string& text);
};

/// The settings of `configuration`, which must outlive them.
std::vector<Setting> settings(Configuration& configuration);

/// Where each setting was given: key -> "config.toml:3", or an option of the command line, "--seed".
using SettingSources = std::map<std::string, std::string>;

/// What is wrong with a setting and where it was given: "config.toml:3: seed must be …", "--views
/// (termination.views) must be …". `reason` begins with the key, or tells of it otherwise.
std::string complaint_about(const std::string& key, const std::string& source, const std::string& reason);

/// Reads TOML over `base`: keys that the file leaves out stay as they are; an unknown key is an error that names the
/// nearest known one. Relative paths in it are relative to its folder; what is not there, to the working folder. With
/// `sources`, notes there what the file gives, and leaves it to the caller to validate what becomes of it.
/// @throws std::runtime_error "file:line: reason".
Configuration read_configuration(const std::filesystem::path& file, const Configuration& base = Configuration(),
                                 SettingSources* sources = nullptr);
/// Configuration::validate(), also telling where what is wrong was given.
/// @throws std::runtime_error
void validate(const Configuration& configuration, const SettingSources& sources);
std::string to_toml(const Configuration& configuration);
/// As a file in `folder` says it, so that it can be read from anywhere: a path is relative to the folder if its target
/// lies inside, absolute otherwise.
std::string to_toml(const Configuration& configuration, const std::filesystem::path& folder);

/// Sets the sensor to a preset: the name of a file in assets/sensors, or a path; notes in `sources` what that gives.
/// @throws std::runtime_error
void apply_sensor_preset(Configuration& configuration, const std::string& preset, SettingSources* sources = nullptr);

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

/// Of `known`, the one that `word` is most likely meant to be.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace nextview
