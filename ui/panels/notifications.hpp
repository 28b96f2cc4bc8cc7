#pragma once
#include <optional>

#include "ui/panels/panel.hpp"

namespace nextview {

/// What was logged a moment ago and is worth an interruption, at the top of the scene: warnings and what was finished.
class Notifications {
 public:
  /// `count`: of all log entries ever. `seconds`: since the last frame.
  void draw(const PanelContext& context, const Rectangle& scene, std::size_t count, double seconds);
  /// Until the next one goes [s]; infinity if there is none.
  double seconds_left() const;

 private:
  struct Note {
    LogEntry entry;
    double seconds_left;
  };
  void drop_outdated(const PanelContext& context);

  std::vector<Note> notes_;
  bool opening_ = false;  ///< another object, in the last frame
  std::string message_;   ///< SessionSnapshot::message in the last frame
  std::size_t seen_ = 0;  ///< log entries
  bool shrinks_ = false;  ///< some were taken away: ImGui gives the window its new height a frame later
};

}  // namespace nextview
