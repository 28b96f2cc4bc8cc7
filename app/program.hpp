#pragma once

namespace nextview {

/// The program `nextview`. Returns its exit code (scarcity.hpp, README).
int run_program(int argc, char** argv);

}  // namespace nextview
