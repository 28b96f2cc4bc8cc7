#include <stdexcept>

#include "core/config/configuration.hpp"
#include "core/setting/numbers.hpp"

namespace nextview {

std::vector<Setting> settings(MapConfig& c) {
  std::vector<Setting> all = {
      {"map.resolution", "m", "voxel edge", &c.resolution, from_to(1e-5, 1)},
      {"map.region_edge", "m", "edge of the region of interest around the object", &c.region_edge, from_to(1e-3, 1000)},
      {"map.region", "m",
       "region of interest as a box, x y z of two opposite corners; "
       "empty: a cube of region_edge around the object",
       &c.region},
      {"map.remove_planes", "", "of an unknown object, whose first scan says where it is: leave ground and walls out",
       &c.remove_planes},
      {"map.start", "", "octree (.ot, .bt) to begin with, in whose world the object lies; empty: nothing is known",
       &c.start},
      {"map.occlusion_distance", "m", "how far behind a surface voxels are marked; the reference code's is 0.3 m",
       &c.occlusion_distance, from_to(1e-3, 1000)},
      {"map.insertion", "", "register a local octree, or insert directly: the same map",
       choice(c.insertion, {"local-octree", "direct"})},
  };
  for (Setting& setting : settings(c.model)) all.push_back(std::move(setting));
  return all;
}

namespace {

Eigen::AlignedBox3d box_of(const char* key, const std::string& text) {
  const std::vector<double> v = numbers(key, text, 6, "x y z of two opposite corners");
  Eigen::AlignedBox3d box(Vector3(v[0], v[1], v[2]));
  return box.extend(Vector3(v[3], v[4], v[5]));
}

}  // namespace

Eigen::AlignedBox3d MapConfig::region_box() const {
  if (region.empty()) return {Vector3::Constant(-0.5 * region_edge), Vector3::Constant(0.5 * region_edge)};
  return box_of("map.region", region);
}

std::optional<Eigen::AlignedBox3d> DriverConfig::volume() const {
  if (working_volume.empty()) return std::nullopt;
  return box_of("robot.working_volume", working_volume);
}

Pose DriverConfig::T_flange_camera() const try {
  return hand_eye.empty() ? Pose::Identity() : parse_view(hand_eye);
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(std::string("driver.hand_eye: ") + error.what());
}

std::vector<Setting> settings(ObjectConfig& c) {
  return {
      {"object.file", "", "mesh or cloud file, or the name of an object that comes with the program", &c.file},
      {"object.longest_side", "m", "scale the object to this; 0 keeps its size", &c.longest_side, zero_or(1e-3, 100)},
      {"object.unit", "", "of its file; auto: the file's own, else mm if it is longer than 10, else m",
       choice(c.unit, {"auto", "m", "mm", "cm", "inch"})},
      {"object.up", "", "which axis of its file points up; auto: y in glTF and X3D, else z",
       choice(c.up, {"auto", "z", "y", "x", "-z", "-y", "-x"})},
      {"object.centred", "", "put its middle in the origin; false: it stays where its file has it", &c.centred},
      {"object.ground", "", "a plane under it, seen and mapped, that coverage does not count", &c.ground},
  };
}

std::vector<Setting> settings(RecordedConfig& c) {
  return {
      {"recorded.folder", "", "scans that were taken elsewhere, instead of a simulated camera's: a folder or file",
       &c.folder},
      {"recorded.truth", "", "mesh of what was scanned, to compare with; it is aligned with the scans", &c.truth},
      {"recorded.start", "", "frame to begin with, its name or the last number in that; empty: the first", &c.start},
      {"recorded.every", "", "takes each n-th frame", &c.every, from_to(1, 1e6)},
      {"recorded.stand_off", "m", "distance of the scanner, which Stanford's range images do not tell", &c.stand_off,
       stand_off_bounds},
  };
}

std::vector<Setting> settings(DriverConfig& c) {
  return {
      {"driver.name", "", "the scanner that took this scan: only it can repeat it (--driver); empty: a simulation",
       &c.name},
      {"driver.timeout", "s", "of each request to a live scanner; 0: for ever where it moves or captures", &c.timeout,
       from_to(0, 1e6)},
      {"driver.hand_eye", "", "T_flange_camera as x y z qx qy qz qw, where the driver's poses are those of the flange",
       &c.hand_eye},
      {"robot.working_volume", "m", "box that the camera must not leave, x y z of two opposite corners; empty: any",
       &c.working_volume},
  };
}

std::vector<Setting> settings(EvaluationConfig& c) {
  return {
      {"evaluation.enabled", "", "compare with the mesh after each view", &c.enabled},
      {"evaluation.d_reg", "m", "registration distance of surface coverage", &c.d_reg, from_to(1e-5, 1)},
      {"evaluation.samples", "", "what coverage is a share of: points spread over the surface, or the mesh's vertices",
       choice(c.samples, {"surface", "vertices"})},
      {"evaluation.surface_samples", "", "points spread over the true surface", &c.surface_samples, from_to(1, 1e7)},
      {"evaluation.any_pose", "", "coverage of what any pose could see too; always with views.layout adaptive",
       &c.any_pose},
  };
}

std::vector<Setting> settings(HistoryConfig& c) {
  return {{"history.memory", "GiB", "that the maps of earlier views may take; older ones are made again from the scans",
           &c.memory, from_to(0, 1024)}};
}

std::vector<Setting> settings(Configuration& c) {
  std::vector<Setting> all = {{"seed", "", "seed of everything random", &c.seed}};
  const auto add = [&](std::vector<Setting> more) { all.insert(all.end(), more.begin(), more.end()); };
  add(settings(c.object));
  add(settings(c.recorded));
  add(settings(c.driver));
  add(settings(c.robot));
  add(settings(c.registration));
  add({{"sensor.preset", "", "paper, narrow, wide, or a file; the other sensor settings override it",
        &c.sensor_preset}});
  add(settings(c.sensor));
  add(settings(c.cloud));
  add(settings(c.map));
  add(settings(c.gibbs));
  add(settings(c.views));
  add(settings(c.planner));
  add(settings(c.termination));
  add(settings(c.evaluation));
  add(settings(c.history));
  return all;
}

}  // namespace nextview
