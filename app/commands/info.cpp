#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "app/commands/commands.hpp"
#include "app/commands/extents_text.hpp"
#include "app/commands/options.hpp"
#include "app/commands/recording_info.hpp"
#include "app/commands/session_info.hpp"
#include "app/commands/session_parts_info.hpp"
#include "app/commands/study_info.hpp"
#include "app/commands/written_file_info.hpp"
#include "core/cloud/point_cloud.hpp"
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
#include "core/results/manifest.hpp"
#include "core/sensor/recorded_scans.hpp"
#include "core/session/object_mesh.hpp"
#include "core/setting/length_text.hpp"
#include "core/study/study.hpp"
#include "core/view/pose.hpp"
#include "ui/demo/demo_window.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

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
                     extents_text(placed.mesh.bounding_box().cast<double>()), unit_text(placed.unit));
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
                     extents_text({box.min() * scale, box.max() * scale}), unit_text(unit));
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
                     extents_text({map.grid().lower(), map.grid().upper()}));
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

std::string picture_info(const fs::path& file) {
  const PngInfo info = read_png_info(file);
  const std::string text = png_configuration(file);
  const std::string size = fmt::format("{} x {} pixels", info.width, info.height);
  if (text.empty()) return fmt::format("a picture of {}; it carries no settings", size);
  const bool is_of_study = is_study(text);
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
  return fmt::format("candidate views: {}\n  {}", counted(views.size(), "view"), extents_text(box));
}

std::string toml_info(const fs::path& path) {
  const std::string text = read_file(path, std::uintmax_t{1} << 20);
  if (!is_study(text)) return configuration_info(path);
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
