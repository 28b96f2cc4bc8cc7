#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// A file that a pattern matched.
struct FrameFile {
  std::filesystem::path file;
  std::string name;  ///< of the frame, for people: the file's name up to the end of what the last wildcard stands for
  std::string key;   ///< what the wildcards stand for; without any, empty
};

/// The files of a folder whose names match a pattern: `*` stands for any text, in the last part of the path alone.
/// Names may also end in .gz; where both are there, the plain one counts. In natural order: frame-2 before frame-10.
/// @throws std::runtime_error in one line: a pattern that leaves the folder or has over four wildcards, a folder that
///         cannot be read. No match is none.
std::vector<FrameFile> find_frame_files(const std::filesystem::path& folder, const std::string& pattern);

/// Whether `a` comes before `b` where runs of digits count as numbers.
bool natural_order(std::string_view a, std::string_view b);

/// Whether two keys mean the same frame: equal, or the same whole number ("0001" and "001").
bool same_key(std::string_view a, std::string_view b);

/// The last whole number in a text, without its leading zeros. ("frame-000012.color" has 12)
std::optional<std::string> last_number(std::string_view text);

}  // namespace nextview
