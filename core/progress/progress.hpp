#pragma once
#include <functional>
#include <string_view>

namespace nextview {

/// Hears how far a job has come, from 0 to 1, and what it is doing. Called from the thread that does the job.
using Progress = std::function<void(double fraction, std::string_view what)>;

}  // namespace nextview
