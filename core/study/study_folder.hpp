#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/file/descriptor.hpp"
#include "core/study/run_result.hpp"
#include "core/study/study.hpp"

namespace nextview {

/// What a study's folder holds, beside what is made of it.
///   study.toml     the study file, byte by byte
///   study.json     the program, the study's name, of each object its file's size and check sum, or why it has none
///   keys           of each run, in their order, 16 hexadecimal digits that follow from all that makes its result: the
///                  program's version, its settings, its object's bytes
///   runs/ab/KEY.json   the result of a run: whole, or not there
///   timings.csv    a row a run that was done here: all that differs between two runs of a study
///   sessions/KEY/  the session of a run, if it is kept
inline constexpr const char* study_file_name = "study.toml";
inline constexpr const char* study_json_name = "study.json";
inline constexpr const char* study_keys_name = "keys";
inline constexpr const char* study_timings_name = "timings.csv";

/// The keys of all runs, in their order, and what they were made from.
struct StudyKeys {
  std::vector<std::string> keys;
  std::map<std::string, std::string> inputs;  ///< by object: "1234 bytes, crc32 0badcafe", or why it cannot be read

  std::string text() const;  ///< a line a run
};
StudyKeys keys_of(const Study& study);

/// 16 hexadecimal digits (FNV-1a): two of a million texts are the same by chance in one of 40 million studies.
std::string text_hash(std::string_view text);

/// What makes a study the one it is, as its folder has it.
struct StudyTexts {
  std::string json, file, keys;
};

class StudyFolder {
 public:
  /// Makes the folder that of a study, or goes on with it. One program writes it at a time.
  /// @throws std::invalid_argument in one line if it holds anything else, another study or, unless it is to be resumed,
  /// this one; if an object or setting has changed; std::runtime_error naming the file
  static StudyFolder begin(const std::filesystem::path& folder, const Study& study, const StudyKeys& keys, bool resume);
  /// Makes the folder that of the same study, without runs, to put a summary into; or takes one that is. @throws
  /// likewise
  static StudyFolder begin_merged(const std::filesystem::path& folder, const StudyFolder& one);
  /// To read from. @throws std::runtime_error if it is no study's folder
  static StudyFolder open(const std::filesystem::path& folder);

  const std::filesystem::path& path() const { return folder_; }
  bool has(const std::string& key) const;
  RunResult result(const std::string& key) const;  ///< @throws std::runtime_error naming the file
  std::filesystem::path session(const std::string& key) const { return folder_ / "sessions" / key; }
  /// Keeps a result, for good, and then its seconds. @throws std::runtime_error naming the file
  void keep(const std::string& key, const StudyRun& run, const RunResult& result, const RunSeconds& seconds) const;

 private:
  explicit StudyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  StudyFolder(const std::filesystem::path& folder, const StudyTexts& study, bool resume);
  std::filesystem::path file_of(const std::string& key) const;
  void lock();
  void add_timing(const std::string& key, const StudyRun& run, const RunSeconds& seconds) const;

  std::filesystem::path folder_;
  Descriptor lock_;
};

/// What a study's folder has by now. It may be written meanwhile.
struct StudyContents {
  std::string name;
  std::size_t runs = 0, done = 0;    ///< done: here; a merged study has none of its own
  std::vector<std::string> objects;  ///< "part.stl (1234 bytes, crc32 0badcafe)"
  bool has_summary = false;
};
/// Nothing if it is no study's folder.
std::optional<StudyContents> study_contents(const std::filesystem::path& folder);

/// The header of timings.csv.
extern const char* const timing_columns;

}  // namespace nextview
