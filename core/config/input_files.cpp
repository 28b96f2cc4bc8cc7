#include "core/config/input_files.hpp"

namespace nextview {

std::vector<InputFile> input_files(const Configuration& c) {
  const std::filesystem::path object = resolve_object(c);
  std::vector<InputFile> inputs = {{object, "the object that is scanned"},
                                   {openings_file(object), "the list of the object's openings"}};
  if (!c.views.file.empty()) inputs.push_back({c.views.file, "the views file"});
  for (const auto& file : c.read_from) inputs.push_back({file, "read as configuration"});
  return inputs;
}

std::filesystem::path openings_file(const std::filesystem::path& object) {
  return std::filesystem::path(object).replace_extension(".json");
}

}  // namespace nextview
