#include "core/study/study_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <sstream>

#include "core/file/atomic_file.hpp"
#include "core/file/csv_cell.hpp"
#include "core/file/json_text.hpp"
#include "core/file/make_folder.hpp"
#include "core/file/readable_folder.hpp"
#include "core/file/temporary_file.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool holds_nothing(const fs::path& folder) {
  std::error_code error;
  return fs::is_empty(folder, error) && !error;
}

std::string text_if_there(const fs::path& file) { return is_there(file) ? read_file(file) : ""; }

/// What it says of its study; none if it is no study's folder.
std::optional<Json> study_of(const fs::path& folder) {
  try {
    Json json = parse_json<Json>(read_file(folder / study_json_name));
    if (json.at("program").get<std::string>().starts_with("nextview ") && json.contains("study")) return json;
  } catch (const std::exception&) {  // it is another's
  }
  return std::nullopt;
}

fs::path run_file(const fs::path& folder, const std::string& key) {
  return folder / "runs" / key.substr(0, 2) / (key + ".json");
}

void require_suitable(const fs::path& folder, const StudyTexts& study, bool resume) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(fmt::format("{}: {}; give another folder, for example --out {}", folder.string(), why,
                                            free_folder(folder).string()));
  };
  if (!study_of(folder)) refuse("is not empty, and holds no study");
  const std::string text = text_if_there(folder / study_file_name), there = text_if_there(folder / study_keys_name);
  if (!text.empty() && text != study.file) refuse("holds another study, or this one before its file was changed");
  if (!there.empty() && there != study.keys)
    refuse("holds this study as another version, other settings or other objects made it");
  if (!resume) refuse("holds this study: --resume goes on with it");
}

std::string study_json(const Study& study, const StudyKeys& keys) {
  Json json = {{"program", "nextview " NEXTVIEW_VERSION}, {"study", study.name}, {"runs", study.size()}};
  json["objects"] = keys.inputs;
  return json_text(json, 2) + "\n";
}

/// What killed programs left, in any of the folders.
void clean_up(const fs::path& folder) {
  remove_abandoned_temporary_files(folder);
  std::error_code error;
  for (fs::directory_iterator entry(folder / "runs", error), end; !error && entry != end; entry.increment(error))
    remove_abandoned_temporary_files(entry->path());
}

}  // namespace

const char* const timing_columns =
    "key,part,object,sensor,views,method,start,seed,sense[s],clean[s],insert[s],refine[s],score[s],evaluate[s],total[s]"
    "\n";

StudyFolder StudyFolder::begin(const fs::path& path, const Study& study, const StudyKeys& keys, bool resume) {
  return StudyFolder(path, {study_json(study, keys), study.text, keys.text()}, resume);
}

StudyFolder StudyFolder::begin_merged(const fs::path& path, const StudyFolder& one) {
  const auto text = [&](const char* name) { return read_file(one.path() / name); };
  return StudyFolder(path, {text(study_json_name), text(study_file_name), text(study_keys_name)}, true);
}

StudyFolder::StudyFolder(const fs::path& path, const StudyTexts& study, bool resume) : folder_(path) {
  if (path.empty()) throw std::invalid_argument("the folder for the study has no name");
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    remove_abandoned_temporary_files(path);
    if (!holds_nothing(path)) require_suitable(path, study, resume);
  }
  make_folder(path);
  lock();
  clean_up(path);
  // The keys come last: where they are, all is.
  if (!is_there(path / study_keys_name)) {
    write_file(path / study_json_name, study.json);
    write_file(path / study_file_name, study.file);
    write_file(path / study_keys_name, study.keys);
    keep_names(path);
    keep_names(path / "..");  // the folder may be new, too
  }
}

std::optional<StudyContents> study_contents(const fs::path& folder) {
  const std::optional<Json> study = study_of(folder);
  if (!study) return std::nullopt;
  StudyContents contents;
  contents.name = study->at("study").get<std::string>();
  for (const auto& [object, input] : study->at("objects").items())
    contents.objects.push_back(fmt::format("{} ({})", object, input.get<std::string>()));
  std::istringstream keys(text_if_there(folder / study_keys_name));
  for (std::string key; std::getline(keys, key); ++contents.runs) contents.done += is_there(run_file(folder, key));
  contents.has_summary = is_there(folder / "summary.csv");
  return contents;
}

StudyFolder StudyFolder::open(const fs::path& folder) {
  require_readable(folder);
  if (!study_of(folder) || !is_there(folder / study_keys_name))
    throw std::runtime_error(fmt::format("{}: is no folder of a study", folder.string()));
  return StudyFolder(folder);
}

void StudyFolder::lock() {
  lock_ = Descriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock_.is_open()) throw file_error(folder_, "opened", errno);
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw std::runtime_error(
        fmt::format("{}: another program runs this study there; shards need a folder each", folder_.string()));
}

fs::path StudyFolder::file_of(const std::string& key) const { return run_file(folder_, key); }

bool StudyFolder::has(const std::string& key) const {
  std::error_code ignored;
  return fs::is_regular_file(file_of(key), ignored);
}

RunResult StudyFolder::result(const std::string& key) const { return read_result(file_of(key)); }

void StudyFolder::keep(const std::string& key, const StudyRun& run, const RunResult& result,
                       const RunSeconds& seconds) const {
  const fs::path file = file_of(key);
  make_folder(file.parent_path());
  write_file(file, to_json(result, key, run));
  keep_names(file.parent_path());
  keep_names(folder_ / "runs");  // in which that may be new
  keep_names(folder_);           // in which that may be
  if (result.failure.empty()) add_timing(key, run, seconds);
}

void StudyFolder::add_timing(const std::string& key, const StudyRun& run, const RunSeconds& seconds) const {
  const fs::path file = folder_ / study_timings_name;
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!out.is_open()) throw file_error(file, "written", errno);
  const off_t before = ::lseek(out.get(), 0, SEEK_END);
  const StageSeconds& s = seconds.stages;
  const std::string row = fmt::format(
      "{}{},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", before == 0 ? timing_columns : "",
      key, name(run.part), csv_cell(object_label(run.object)), csv_cell(run.sensor), run.views, csv_cell(run.method),
      run.start, run.seed, s.sense, s.clean, s.insert, s.refine, s.score, s.evaluate, seconds.total);
  const int error = write_all(out.get(), row);
  if (error == 0) return;
  [[maybe_unused]] const int ignored = ::ftruncate(out.get(), before);  // the next row would join a part of this one
  throw file_error(file, "written", error);
}

}  // namespace nextview
