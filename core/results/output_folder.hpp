#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/results/input_file.hpp"
#include "core/results/made_folder.hpp"
#include "core/results/manifest.hpp"

namespace nextview {

/// A folder that results are written to. Three things are seen to: no input is replaced; what an earlier run left there
/// goes, and nothing else; and its list of what it wrote (manifest.json) is right whenever the run ends.
class OutputFolder {
 public:
  /// Looks, but touches nothing. @throws std::invalid_argument, std::runtime_error with one line if it is a file, if it
  /// is an input itself or holds one (by whatever link or spelling) under a name that results have, or if its
  /// manifest.json is not Nextview's.
  /// `option` goes before the folder that the line proposes instead.
  OutputFolder(std::filesystem::path folder, std::span<const InputFile> inputs, std::string_view option = "--out ");

  /// Makes the folder and sees that it can be written to: before a long job. @throws as MadeFolder
  [[nodiscard]] MadeFolder make() const { return MadeFolder(folder_); }
  /// Makes it, removes what an earlier run left, and begins the list of what `command` leaves. `object` is what is
  /// scanned, if it is known. @throws std::runtime_error naming the file and the reason.
  void begin(const std::string& command, const std::optional<std::filesystem::path>& object = std::nullopt);
  /// Goes on with the list that is there, or begins one; nothing is removed. @throws std::runtime_error likewise
  void go_on(const std::string& command);
  /// Removes what its list names, and the folder if nothing else is in it. @throws std::runtime_error likewise
  void remove() const;
  /// Where to write the result of this name; it is on the list from now on. @pre begin() or go_on() was called;
  /// is_result_name(name). @throws std::runtime_error if the list cannot be written.
  std::filesystem::path claim(const std::string& name);

  const std::filesystem::path& path() const { return folder_; }

 private:
  void require_no_input(std::span<const InputFile> inputs, std::string_view option) const;
  void remove_earlier_results() const;

  std::filesystem::path folder_;
  Manifest manifest_;
};

/// This folder, or the first one beside it that is not there yet: out, out-2, out-3, …
std::filesystem::path free_folder(const std::filesystem::path& folder);

/// How results in `folder` name a file: relative to the folder if it lies inside, absolute otherwise.
std::string named_from(const std::filesystem::path& folder, const std::filesystem::path& file);

/// @throws std::runtime_error naming both if the folder's manifest says that its results are of an object that was not
/// the one in this file, or has changed since.
void require_same_object(const std::filesystem::path& folder, const std::filesystem::path& object);

}  // namespace nextview
