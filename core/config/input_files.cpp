#include "core/config/input_files.hpp"

namespace nextview {

std::vector<InputFile> input_files(const Configuration& c) {
  std::vector<InputFile> inputs;
  if (c.recorded.folder.empty()) {
    const std::filesystem::path object = resolve_object(c);
    inputs = {{object, "the object that is scanned"}, {openings_file(object), "the list of the object's openings"}};
  } else {
    inputs = recorded_files(c.recorded.folder);
    if (!c.recorded.truth.empty()) inputs.push_back({resolve_object(c.recorded.truth), "the mesh to compare with"});
  }
  if (!c.map.start.empty()) inputs.push_back({c.map.start, "the map to begin with"});
  if (!c.views.file.empty()) inputs.push_back({c.views.file, "the views file"});
  for (const auto& file : c.read_from) inputs.push_back({file, "read as configuration"});
  return inputs;
}

std::vector<InputFile> recorded_files(const std::filesystem::path& recorded) {
  std::vector<InputFile> files = {{recorded, "the recorded scans"}};
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(recorded, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    files.push_back({entry->path(), "of the recorded scans"});
  return files;
}

std::filesystem::path openings_file(const std::filesystem::path& object) {
  return std::filesystem::path(object).replace_extension(".json");
}

}  // namespace nextview
