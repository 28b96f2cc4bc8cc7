#pragma once
#include <string>

namespace nextview {

/// Prepares the process for too little memory (`ulimit -v`, a full machine) and too few threads (`ulimit -u`). Only so
/// many threads are used as can be started; and where a library cannot be kept from dying of what is missing, the
/// process ends with one line and exit code 2 all the same. To be called once, before anything else.
/// @throws std::runtime_error if not a single thread can be started.
void prepare_for_scarcity();

/// One line for an allocation that failed.
std::string out_of_memory_line();

}  // namespace nextview
