#pragma once
#include <string>
#include <string_view>

namespace nextview {

/// Why an entry out of a file is no text: a NUL in its key or its value would end each message about it, and the name
/// of a file. Empty if there is none.
std::string why_no_text(std::string_view key, std::string_view value);

}  // namespace nextview
