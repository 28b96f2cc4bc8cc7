#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "core/config/configuration.hpp"
#include "core/config/known_objects.hpp"
#include "core/file/installation.hpp"
#include "core/file/read_file.hpp"
#include "core/results/output_folder.hpp"
#include "core/setting/mistyped_path.hpp"

namespace nextview {

namespace fs = std::filesystem;

std::string to_toml(const Configuration& configuration, const fs::path& folder) {
  Configuration named = configuration;
  const auto name_from_folder = [&](std::string& file, bool may_be_folder = false) {
    std::error_code ignored;
    if (!file.empty() && fs::exists(file, ignored) && (may_be_folder || !fs::is_directory(file, ignored)))
      file = named_from(folder, file);
  };
  name_from_folder(named.object.file);
  name_from_folder(named.views.file, true);
  name_from_folder(named.map.start);
  name_from_folder(named.recorded.truth);
  name_from_folder(named.recorded.folder, true);
  if (!is_there(named_sensor(named.sensor_preset))) name_from_folder(named.sensor_preset);
  return to_toml(named);
}

fs::path assets_folder() {
  const char* folder = std::getenv("NEXTVIEW_ASSETS");
  return folder ? fs::path(folder) : shared_folder("assets");
}

fs::path named_sensor(const std::string& preset) { return assets_folder() / "sensors" / (preset + ".toml"); }

fs::path default_object() {
  const fs::path gearbox = "/usr/share/opencascade/data/stl/TR12J_OCC.stl";
  return fs::exists(gearbox) ? gearbox : assets_folder() / "objects" / "slotted_housing.ply";
}

fs::path resolve_object(const std::string& name) {
  if (name.empty()) return default_object();
  std::error_code ignored;
  const bool is_folder = fs::is_directory(name, ignored);
  if (is_there(name) && !is_folder) return name;
  if (name == "gearbox") return default_object();
  if (name == "bunny") return "/usr/share/glmark2/models/bunny.obj";
  for (const char* ending : {"", ".ply"}) {
    fs::path file = assets_folder() / "objects" / (name + ending);
    if (fs::is_regular_file(file, ignored)) return file;
  }
  if (is_folder) return name;  // which its reader refuses; those of known names are no hindrance
  const std::vector<std::string> objects(known_objects().begin(), known_objects().end());
  if (std::ranges::find(objects, name) != objects.end())
    throw std::runtime_error(fmt::format(
        "{}: comes with the program, but is not in {}; install the program whole, or set NEXTVIEW_ASSETS to "
        "its folder assets",
        name, (assets_folder() / "objects").string()));
  throw std::runtime_error(
      fmt::format("{}: there is no such file, nor an object of this name that comes with the program{}", name,
                  did_you_mean_path(name, objects)));
}

fs::path resolve_object(const Configuration& configuration) {
  try {
    return resolve_object(configuration.object.file);
  } catch (const std::runtime_error& error) {
    const std::string key = "object.file: ";
    const std::string told = configuration.as_given(key + error.what());
    throw std::runtime_error(told.starts_with(key) ? error.what() : told);  // one that no one gave a name has none
  }
}

}  // namespace nextview
