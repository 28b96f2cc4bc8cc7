#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// A demo: lines of commands (parse_script).
struct Demo {
  std::filesystem::path file;
  std::vector<CommandCall> calls;
  std::string needs = {};  ///< from where what it opens comes, as its first comment "# needs: …" says; empty: from here
};

/// Of the demos that come with the program.
std::vector<std::string> demo_names();

/// Whether a file is one, by its ending.
bool is_demo_file(const std::filesystem::path& file);

/// Of a file, or one of those that come with the program by its name. What it writes goes below `folder`, and without
/// one it may write nothing. @throws std::runtime_error in one line, "FILE:LINE: reason" where a line is wrong.
Demo read_demo(const std::string& file_or_name, const std::filesystem::path& folder = {});

/// What it opens and is not there: "FILE:LINE: gearbox: there is no …", a line each, with what the demo needs.
std::vector<std::string> missing_data(const Demo& demo);
/// @throws std::runtime_error naming the first of them.
void require_data(const Demo& demo);

}  // namespace nextview
