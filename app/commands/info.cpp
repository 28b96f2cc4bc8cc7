#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/session_info.hpp"
#include "app/commands/session_parts_info.hpp"
#include "app/commands/study_info.hpp"
#include "app/commands/written_file_info.hpp"
#include "core/cloud/point_cloud.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "core/config/configuration_text.hpp"
#include "core/config/object_lengths.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/png_text.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/journal/journal.hpp"
#include "core/map/octree_file.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/recording/dataset_guess.hpp"
#include "core/recording/recording.hpp"
#include "core/results/manifest.hpp"
#include "core/sensor/recorded_scans.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/saved_session.hpp"
#include "core/setting/length_text.hpp"
#include "core/study/study.hpp"
#include "core/view/pose.hpp"
#include "ui/demo/demo_window.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// "from (…) to (…)", in the unit that suits.
std::string extents(const Eigen::AlignedBox3d& box) {
  const Vector3 size = box.sizes();
  const bool small = size.maxCoeff() < 1.0;
  const double unit = small ? 1e3 : 1.0;
  const auto triple = [&](const Vector3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", unit * v.x(), unit * v.y(), unit * v.z());
  };
  return fmt::format("{:.4g} x {:.4g} x {:.4g} {}, from {} to {}", unit * size.x(), unit * size.y(), unit * size.z(),
                     small ? "mm" : "m", triple(box.min()), triple(box.max()));
}

template <class Points>
Eigen::AlignedBox3d box_of(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point.template cast<double>());
  return box;
}

std::string unit_text(LengthUnit unit) {
  if (unit == LengthUnit::automatic) return "its size is declared, as it comes with the program";
  return fmt::format("its unit is taken as {} (object.unit overrules it)", name(unit));
}

std::string mesh_info(const fs::path& file) {
  ObjectConfig as_it_stands;
  as_it_stands.centred = false;
  as_it_stands.up = UpAxis::z;
  const PlacedMesh placed = load_object_mesh(file, placement(as_it_stands, file));
  return fmt::format("a mesh of {} and {}; {}\n  {}\n  {}", counted(placed.mesh.triangles.size(), "triangle"),
                     counted(placed.mesh.vertices.size(), "vertex", "vertices"), placed.topology.summary(),
                     extents(placed.mesh.bounding_box().cast<double>()), unit_text(placed.unit));
}

/// As an object that is scanned, but for its surface, which takes long to make.
std::string cloud_info(const fs::path& file) {
  const CloudFile read = read_cloud_file(file);
  const PointCloud& cloud = read.points;
  const Eigen::AlignedBox3d box = box_of(cloud);
  constexpr double longest_in_metres = 10.0;
  const bool in_mm = !cloud.empty() && box.sizes().maxCoeff() > longest_in_metres;
  const LengthUnit unit = in_mm ? LengthUnit::millimetres : LengthUnit::metres;
  const double scale = metres_per(unit);
  return fmt::format("a cloud of {}\n  {}\n  {}", points_text(cloud.size(), read.left_out),
                     extents({box.min() * scale, box.max() * scale}), unit_text(unit));
}

std::string map_info(const fs::path& file) {
  const OccupancyMap map = read_octree(file);
  std::size_t measured = 0, occupied = 0;
  for (const Voxel& voxel : map.voxels()) {
    measured += voxel.measured;
    occupied += voxel.measured && voxel.probability >= map.model().occupancy_threshold;
  }
  const Eigen::Vector3i size = map.grid().size;
  return fmt::format("an occupancy map (OctoMap): {} x {} x {} voxels of {}, {} of them measured, {} occupied\n  {}",
                     size.x(), size.y(), size.z(), length_text(map.grid().resolution), measured, occupied,
                     extents({map.grid().lower(), map.grid().upper()}));
}

std::string scene_info(const RecordedScene& scene) {
  std::size_t points = 0;
  Eigen::AlignedBox3d box;
  for (const RecordedScan& scan : scene.scans) {
    points += scan.points.size();
    for (const Vector3& point : scan.points) box.extend(scan.T_world_camera * point);
  }
  std::string text = fmt::format("{} with {}, and {} to be scored", counted(scene.scans.size(), "scan"),
                                 counted(points, "point"), counted(scene.views.size(), "view"));
  if (points > 0) text += "\n  " + extents(box);
  for (const auto& [name, value] : scene.parameters) text += fmt::format("\n  {} {:g}", name, value);
  return text;
}

std::string configuration_info(const fs::path& file) {
  Configuration configuration;
  read_settings(file, configuration);
  configuration.validate();
  std::string text = fmt::format("a configuration that gives {}", counted(configuration.sources.size(), "setting"));
  for (const auto& [key, source] : configuration.sources)
    text += fmt::format("\n  {} = {}", key, printable(source.text));
  return text;
}

bool is_study_text(const std::string& toml) {
  return toml.find("[[planning]]") != toml.npos || toml.find("[[maps]]") != toml.npos;
}

std::string picture_info(const fs::path& file) {
  const PngInfo info = read_png_info(file);
  const std::string text = png_configuration(file);
  const std::string size = fmt::format("{} x {} pixels", info.width, info.height);
  if (text.empty()) return fmt::format("a picture of {}; it carries no settings", size);
  const bool is_of_study = is_study_text(text);
  if (!is_of_study) configuration_of(text, file);  // it is one
  std::string lines =
      fmt::format("a picture of {} by Nextview, with the {} that it shows:", size, is_of_study ? "study" : "settings");
  std::istringstream toml(text);
  for (std::string line; std::getline(toml, line);)
    if (!line.empty()) lines += "\n  " + printable(line);
  return lines;
}

std::string results_info(const fs::path& folder, const Manifest& manifest) {
  std::string text = fmt::format("results of `nextview {}` ({}): {}", manifest.command, manifest.program,
                                 counted(manifest.files.size(), "file"));
  if (manifest.object) text += "\n  object: " + printable(manifest.object->file);
  if (fs::exists(folder / "views.csv")) {
    const std::string views = read_file(folder / "views.csv", std::uintmax_t{1} << 24);
    text += "\n  " + counted(std::size_t(std::max<std::ptrdiff_t>(1, std::ranges::count(views, '\n'))) - 1, "view");
  }
  if (has_journal(folder)) text += "\n" + session_info(folder);
  return text;
}

std::string recording_info(const fs::path& path) {
  const Recording recording = open_recording(path);
  const PinholeCamera& camera = recording.camera;
  std::string text = fmt::format(
      "recorded data ({}): {} with {}\n  {}\n  camera of {} x {} pixels, fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}; "
      "ranges up to {}",
      recording.format, counted(recording.frames.size(), "frame"), counted(recording.points, "point"),
      extents(recording.extent), camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
      length_text(recording.max_range));
  if (recording.region) text += "\n  region of interest: " + extents(*recording.region);
  for (const std::string& line : recording.guessed) text += "\n  " + printable(line);
  return text;
}

/// Writes down what was guessed of a folder, to be corrected by hand; of one that nothing is known of, a template.
std::string write_dataset(const fs::path& folder) {
  const fs::path file = folder / "dataset.toml";
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: is no folder; --write-dataset takes folders", folder.string()));
  if (is_session(folder))
    throw std::runtime_error(
        fmt::format("{}: is a session, whose captures are read as they are; no dataset.toml is needed: "
                    "nextview scan --recorded {}",
                    folder.string(), folder.string()));
  if (is_there(file))
    throw std::runtime_error(fmt::format("{}: is there already; it is not written over", file.string()));
  const auto guess = guess_dataset(folder);
  if (!guess) {
    DatasetDescription example;
    example.frames = "depth/*.png";
    example.poses = "poses/*.txt";
    example.intrinsics = "525 525 319.5 239.5";
    write_file(file, to_toml(example));
    return "dataset.toml is written as a template: nothing about the folder is known, so fill it in";
  }
  write_file(file, to_toml(guess->description));
  try {
    return "dataset.toml is written\n  " + recording_info(folder);
  } catch (const std::runtime_error& error) {  // a wrong guess is what the file is for
    return fmt::format("dataset.toml is written, and is to be corrected: {}", error.what());
  }
}

/// Stanford's range images as scenes to be scored.
std::string range_scans_info(const fs::path& folder) {
  std::string notice;
  const RecordedScene scene =
      read_range_scan_folder(folder, default_stand_off, 0.0, [&](const std::string& text) { notice += "\n  " + text; });
  return fmt::format(
      "range scans (Stanford): {}{}\n  the scanner's distance is not told: it is taken to stand {} m off each scan's "
      "nearest point (recorded.stand_off, --stand-off)",
      scene_info(scene), notice, default_stand_off);
}

std::string folder_info(const fs::path& folder) {
  if (const auto study = study_contents(folder)) return study_info(folder, *study);
  if (const auto manifest = read_manifest(folder)) return results_info(folder, *manifest);
  const bool stanford =
      describe_dataset(folder).description.format == RecordingFormat::stanford && !is_there(folder / "dataset.toml");
  return stanford ? range_scans_info(folder) : recording_info(folder);
}

/// A scene, or a file of candidate views; what is neither is told as a scene.
std::string text_info(const fs::path& path) {
  std::vector<Pose> views;
  try {
    views = read_views(path);
  } catch (const std::runtime_error&) {
    return "a scene of recorded scans: " + scene_info(read_recorded_scene(path));
  }
  Eigen::AlignedBox3d box;
  for (const Pose& view : views) box.extend(view.translation());
  return fmt::format("candidate views: {}\n  {}", counted(views.size(), "view"), extents(box));
}

std::string toml_info(const fs::path& path) {
  const std::string text = read_file(path, std::uintmax_t{1} << 20);
  if (!is_study_text(text)) return configuration_info(path);
  const std::size_t runs = read_study(path).size();
  return fmt::format("a study of {}: nextview study {} --out DIR", counted(runs, "run"), printable(path.string()));
}

std::string demo_info(const fs::path& file) {
  const Demo demo = read_demo(file.string(), "out");
  return fmt::format("a demo of {}: nextview demo {}", counted(demo.calls.size(), "command"), printable(file.string()));
}

std::string info(const fs::path& path) {
  std::error_code ignored;  // what cannot be looked at is told by who reads it
  if (const auto part = session_part_info(path)) return *part;
  if (fs::is_directory(path, ignored)) return folder_info(path);
  const std::string extension = path.extension().string();
  if (extension == ".ot" || extension == ".bt") return map_info(path);
  if (extension == ".graph" || extension == ".log" || path.filename() == "dataset.toml") return recording_info(path);
  if (extension == ".png") return picture_info(path);
  if (extension == ".npy") return depth_image_info(path);
  if (is_demo_file(path)) return demo_info(path);
  if (extension == ".toml") return toml_info(path);
  if (is_scene_file(path)) return text_info(path);
  if (is_there(path) && (extension == ".csv" || extension == ".json")) {
    if (const auto written = written_file_info(path)) return *written;
    throw std::runtime_error(path.string() + ": is no table or report that Nextview writes");
  }
  const fs::path object = resolve_object(path.string());
  return is_cloud(object) ? cloud_info(object) : mesh_info(object);
}

int run(const std::vector<std::string>& paths, bool writes_dataset) {
  int code = 0;
  for (const std::string& path : paths) try {
      fmt::print("{}: {}\n", printable(path), writes_dataset ? write_dataset(path) : info(path));
    } catch (const std::exception& error) {
      fmt::print(stderr, "nextview: {}\n", printable(error.what()));
      code = exit_bad_input;
    }
  return code;
}

}  // namespace

void add_info_command(CLI::App& program) {
  auto paths = std::make_shared<std::vector<std::string>>();
  CLI::App* app =
      program.add_subcommand("info", "What a file or folder holds: counts, extents, unit, what was guessed");
  app->add_option("PATH", *paths,
                  "mesh, cloud (PLY, PCD), map (.ot, .bt), scene of scans or views (.txt), scan graph (.graph, .log), "
                  "configuration or study (.toml), picture (.png), depth image (.npy), demo (.nextview), tables and "
                  "reports that were written (.csv, .json), journal, "
                  "a folder of results or of recorded data, or gearbox, bunny, …")
      ->required()
      ->check(not_empty())
      ->transform(kept_session());
  auto writes_dataset = std::make_shared<bool>(false);
  app->add_flag(
      "--write-dataset", *writes_dataset,
      "write FOLDER/dataset.toml: what was guessed of recorded data, to be corrected; never over one that is there");
  app->footer(
      "Examples:\n  nextview info part.stl\n  nextview info out out/map.ot out/cloud.ply\n  nextview info scans "
      "--write-dataset");
  app->callback([paths, writes_dataset] { throw CLI::RuntimeError(run(*paths, *writes_dataset)); });
}

}  // namespace nextview
