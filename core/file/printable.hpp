#pragma once
#include <string>
#include <string_view>

namespace nextview {

/// Text out of files and file names, as it can go to a terminal in one line. Line breaks, escape sequences and
/// whatever else would act rather than show is written as in C (`\n`, `\x1b`, `\u202e`), and so are bytes that are not
/// UTF-8 (`\xff`). Everything else, blanks and letters of any script, stays.
std::string printable(std::string_view text);

}  // namespace nextview
