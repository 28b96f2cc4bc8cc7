#pragma once
#include <filesystem>
#include <memory>

#include "core/session/session.hpp"
#include "ui/figures/step_figure.hpp"

namespace nextview {

/// What the session's last step looks like: the map after it, and how the candidates rank for the next. Points into the
/// session.
/// @pre the session has taken a step
StepPicture step_picture(const Session& session);

/// The curves of a session up to its last step.
std::vector<ChartContent> session_charts(const Session& session);

/// Draws a session's steps headless, one after the other.
class SessionFigure {
 public:
  SessionFigure();
  ~SessionFigure();
  /// @throws std::runtime_error if the file cannot be written.
  void write(const Session& session, const std::filesystem::path& file);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace nextview
