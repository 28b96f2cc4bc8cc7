#pragma once
#include "ui/workbench/session_runner.hpp"

namespace nextview {

/// Of work that nobody watches or stops.
inline SessionRunner::JobControl job_control() {
  return {[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
}

inline Pose custom_view() { return look_at(Vector3(0.31, -0.62, 0.47), Vector3(0.02, 0.01, -0.03)); }

}  // namespace nextview
