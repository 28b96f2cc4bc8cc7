#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// One name in a folder.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  bool is_session = false;      ///< a folder that is opened as a whole
  std::uintmax_t bytes = 0;     ///< of a file
  std::string not_opened = {};  ///< why a file is not, by its name; empty: it may be
};

/// A folder that is looked into, and what is written into the field below it. Knows nothing of how it is drawn.
class FileBrowser {
 public:
  /// Looks into a folder, or, if that cannot be, into the nearest above it that can.
  void go_to(const std::filesystem::path& folder);
  void go_up() { go_to(folder_.parent_path()); }
  /// Looks into the folder that a path begins with, if it is there. Returns what is left of the path.
  std::string enter(const std::string& written);

  const std::filesystem::path& folder() const { return folder_; }
  /// Folders first, then files, each by name.
  const std::vector<FolderEntry>& entries() const { return entries_; }
  /// Why there is nothing to be seen; empty if there is.
  const std::string& problem() const { return problem_; }

  /// Those whose names hold what is written, in any case: places in entries(). Hidden ones only if what is written
  /// begins with a dot.
  std::vector<std::size_t> matching(std::string_view written) const;
  /// The file that is meant by what is written: a name in this folder, or a path; "~" is the home folder.
  std::filesystem::path meant(const std::string& written) const;
  /// What is written, with as much added as all names have that begin with it; a folder's ends in a slash.
  std::string completed(const std::string& written) const;

 private:
  std::filesystem::path folder_;
  std::vector<FolderEntry> entries_;
  std::string problem_;
};

/// "3.4 MB"
std::string size_in_words(std::uintmax_t bytes);

}  // namespace nextview
