#include "core/config/input_files.hpp"

namespace nextview {
namespace {

/// With the files in `folder`, if it is one.
void add_with_files(const std::filesystem::path& folder, const char* what, const char* what_of_files,
                    std::vector<InputFile>& inputs) {
  inputs.push_back({folder, what});
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    inputs.push_back({entry->path(), what_of_files});
}

}  // namespace

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
  if (!c.views.file.empty()) add_with_files(c.views.file, "the views file", "of the folder of views", inputs);
  for (const auto& file : c.read_from) inputs.push_back({file, "read as configuration"});
  return inputs;
}

std::vector<InputFile> recorded_files(const std::filesystem::path& recorded) {
  std::vector<InputFile> files;
  add_with_files(recorded, "the recorded scans", "of the recorded scans", files);
  return files;
}

std::filesystem::path openings_file(const std::filesystem::path& object) {
  return std::filesystem::path(object).replace_extension(".json");
}

}  // namespace nextview
