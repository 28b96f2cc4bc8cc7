#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// The words of a command line as a POSIX shell splits it: blanks separate, single and double quotes and backslashes
/// hold together. Nothing is expanded, and no shell runs: `$HOME`, `*` and `|` are what they are.
/// @throws std::invalid_argument for a quote that is not closed, a backslash at the end, no word at all
std::vector<std::string> shell_words(std::string_view text);

/// What people call the program of such words: the script where an interpreter runs one ("python3 -u driver.py"), else
/// the first word. @pre there is one
std::string program_named(const std::vector<std::string>& words);

}  // namespace nextview
