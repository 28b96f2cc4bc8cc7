#pragma once
#include <string>

namespace nextview {

/// A conversation with our simulated scanner by the driver protocol, as it goes: a request a line behind "→", its
/// answer behind "←". The same each time.
std::string protocol_example();

}  // namespace nextview
