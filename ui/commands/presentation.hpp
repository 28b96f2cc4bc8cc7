#pragma once
#include <deque>
#include <optional>
#include <string>

#include "core/view/pose.hpp"

namespace nextview {

/// Something that a demo shows over the window for a while; it fades in and out.
struct ShownText {
  std::string text;      ///< of a highlight: the panel's name
  std::string subtitle;  ///< of a title
  double age = 0;        ///< for how long it has been shown [s]; below 0: it waits for the one before to go
  std::optional<double> length = {};  ///< for how long it is shown [s]; none: until the next one

  double opacity() const;  ///< from 0 to 1
  double left() const;     ///< of its time [s]; 0 if it has no end
  bool is_over() const { return length && age >= *length; }
};

/// A motion of the scene's camera, slow at its begin and end.
struct CameraFlight {
  bool relative = false;  ///< around what is looked at, by these angles; else to where the object is seen from there
  double azimuth = 0, elevation = 0;  ///< [deg]
  double zoom = 1;                    ///< how much nearer than where the object is framed; of no meaning if relative
  double seconds = 0;                 ///< that it takes
  double elapsed = 0;                 ///< of them [s]
  std::optional<Vector3> focus = {};  ///< what is looked at in the end [m, world]; none: the middle of the object
};

/// What a demo shows beside the session, by its own time: that passes only while a line of it waits (command::wait),
/// or when no script is left. So what is seen depends neither on the clock nor on how long something computes.
struct Presentation {
  bool demo = false;       ///< a demo is played: it has the keyboard and the pointer, until the operator takes over
  bool captioned = false;  ///< it has captions: there is room for them from its begin on
  double time = 0;         ///< that has passed [s]
  bool paused = false;     ///< by the operator
  std::optional<ShownText> caption, leaving_caption, title, highlight;
  std::deque<CameraFlight> flights;  ///< one after the other
  double hold = 0;                   ///< for how long the script still waits [s]
  double due = 0;  ///< has passed for the next wait, as a frame came later than the last one's end [s]

  /// Shows a caption from now on, once the one before has faded; an empty one only takes that away.
  void show_caption(const std::string& text, std::optional<double> seconds);
  /// Shows a title from now on; the one that a demo begins with is there from the first frame on.
  void show_title(const std::string& text, const std::string& subtitle, double seconds);
  /// The script waits; none: until flights, titles and highlights have ended, and captions that have a time.
  void wait(std::optional<double> seconds);
  bool holds() const;      ///< the script waits
  bool is_moving() const;  ///< something changes as time passes
  double left() const;     ///< until all that has an end has ended [s]
  /// Lets time pass [s]: what has come since the last frame. While a script plays, no more than it waits for; the
  /// rest is kept. Returns how much did, by which flights are to go on.
  double pass(double seconds, bool script_plays);
};

/// Of a motion that begins and ends at rest: the share of its way at a share of its time.
double eased(double share);

}  // namespace nextview
