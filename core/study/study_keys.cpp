#include <fmt/format.h>

#include <tuple>

#include "core/config/input_files.hpp"
#include "core/file/file_hash.hpp"
#include "core/file/read_file.hpp"
#include "core/study/study_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr const char* result_version = "result 1";  // another measure makes it another one

std::uint64_t hash_of_text(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3u;
  return hash;
}

std::string file_text(const fs::path& file) {
  const FileHash hash = file_hash(file);
  return fmt::format("{} bytes, crc32 {}", hash.bytes, hash.crc32);
}

/// What makes an object the one it is, and the openings that are known of it.
std::string object_text(const Study& study, const std::string& object) {
  try {
    const fs::path file = resolve_object(beside_study(study.file, object));
    const fs::path openings = openings_file(file);
    std::error_code ignored;
    return file_text(file) + (fs::is_regular_file(openings, ignored) ? "; openings " + file_text(openings) : "");
  } catch (const std::exception&) {
    return "cannot be read";  // its runs say why
  }
}

/// Settings by what they say, files that they name by what is in them: the same wherever these lie.
std::string settings_text(Configuration c) {
  std::string files;
  for (std::string* file : {&c.views.file, &c.map.start}) {
    std::error_code ignored;
    if (fs::is_regular_file(*file, ignored)) files += file_text(*file) + "\n";
    if (!files.empty()) file->clear();
  }
  c.object.file.clear();
  c.sensor_preset.clear();  // its settings stand for themselves
  c.seed = 0;
  c.planner.start_azimuth = c.planner.start_elevation = 0.0;
  return files + to_toml(c);
}

}  // namespace

std::string text_hash(std::string_view text) { return fmt::format("{:016x}", hash_of_text(text)); }

std::string StudyKeys::text() const {
  std::string text;
  text.reserve(17 * keys.size());
  for (const std::string& key : keys) (text += key) += '\n';
  return text;
}

StudyKeys keys_of(const Study& study) {
  StudyKeys result;
  std::map<std::tuple<std::size_t, std::string, int, std::string>, std::uint64_t> by_settings;
  for (const StudyBlock& block : study.blocks)
    for (const std::string& object : block.objects)
      if (!result.inputs.contains(object)) result.inputs[object] = object_text(study, object);
  result.keys.reserve(study.size());
  for (std::size_t i = 0; i < study.size(); ++i) {
    const StudyRun run = study.run(i);
    const auto [settings, is_new] = by_settings.try_emplace({run.block, run.sensor, run.views, run.method}, 0);
    if (is_new)
      settings->second = hash_of_text("nextview " NEXTVIEW_VERSION + std::string("\n") + result_version + "\n" +
                                      (run.part == StudyPart::maps ? study.map_kind(run) : "") + "\n" +
                                      settings_text(configuration_of(study, run)));
    const std::string label =
        fmt::format("{}\n{}\n{}\n{}", name(run.part), run.object, run.text(), result.inputs.at(run.object));
    result.keys.push_back(fmt::format("{:016x}", hash_of_text(label, settings->second)));
  }
  return result;
}

}  // namespace nextview
