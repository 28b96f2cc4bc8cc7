#pragma once
#include <filesystem>

#include "core/session/session.hpp"
#include "ui/figures/step_figure.hpp"

namespace nextview {

/// What the session's last step looks like: the map after it, and how the candidates rank for the next. Points into the
/// session.
/// @pre the session has taken a step
StepPicture step_picture(const Session& session);

/// The curves of a session up to its last step.
std::vector<ChartContent> session_charts(const Session& session);

/// Draws a session's steps, one after the other.
class SessionFigure {
 public:
  /// Draws over the whole target, which must live longer. Made for 1600 x 1000 pixels.
  explicit SessionFigure(RenderTarget& target) : target_(target), figure_(target) {}
  /// @throws std::runtime_error if the file cannot be written.
  void write(const Session& session, const std::filesystem::path& file);

 private:
  RenderTarget& target_;
  StepFigure figure_;
};

}  // namespace nextview
