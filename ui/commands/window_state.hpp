#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/session/untitled_sessions.hpp"
#include "core/view/pose.hpp"
#include "ui/appearance/picture_size.hpp"
#include "ui/commands/demo_recording.hpp"
#include "ui/commands/panel_list.hpp"
#include "ui/commands/presentation.hpp"
#include "ui/workbench/candidate_order.hpp"
#include "ui/workbench/layer_choice.hpp"
#include "ui/workbench/measurement.hpp"
#include "ui/workbench/selection_history.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

enum class CurveKind { entropy, coverage, divergence, gain, time };

/// What is brought into view: what is scanned, all that is shown, or the region of interest.
enum class Framed { object, all, region };

/// What the scene's camera is to do.
namespace camera_motion {
struct Frame {
  Framed what = Framed::object;
};
struct LookFrom {
  double azimuth, elevation;  ///< [deg]
};
/// Around the object, as a drag does.
struct Turn {
  double azimuth, elevation;  ///< [deg] to the right and up
};
struct LookThrough {
  Pose T_world_camera;
};
struct Zoom {
  double steps;
};
struct GoTo {
  Pose T_world_camera;
};
}  // namespace camera_motion
using CameraMotion = std::variant<camera_motion::Frame, camera_motion::LookFrom, camera_motion::Turn,
                                  camera_motion::LookThrough, camera_motion::Zoom, camera_motion::GoTo>;

/// A picture that is asked for.
struct PictureRequest {
  enum class Of { window, scene, turntable, curves };
  Of of = Of::window;
  std::string file;                      ///< of a turntable: its folder
  std::optional<PictureSize> size = {};  ///< none: as it is in the window
  bool transparent = false;              ///< without a background; not of the window
  int frames = 1, drawn = 0;  ///< of a turntable: how many, and how many of them so far; of a window of another size
                              ///< how many frames were drawn of it to let it settle

  bool operator==(const PictureRequest&) const = default;
};

/// How much of the window panels take, where there is room for it [px] on a display that does not scale.
struct PlaceSizes {
  double left = 272, right = 336, lower = 236;  ///< widths, and the height of those below
  static constexpr double smallest = 120, largest = 2000;

  bool operator==(const PlaceSizes&) const = default;
};

/// Everything that is the window's own and not the session's; only commands change it.
struct WindowState {
  LayerChoice layers;
  Selection selection;
  SelectionHistory selections;
  std::array<std::string, 3> front;  ///< names of panels, by Side; empty: the first of its side
  Side open = Side::right;  ///< the side whose panels were asked for last: it is shown where there is room for one
  std::array<CurveKind, 2> curves = {CurveKind::entropy, CurveKind::coverage};  ///< left and right plot
  CandidateColumn sort_column = CandidateColumn::utility;
  bool sort_ascending = false;
  std::optional<Measurement> measurement;  ///< clicks pick its points
  bool edit_region = false;                ///< the mouse drags the region of interest
  bool palette_open = false, shortcuts_open = false;
  std::string palette_text;  ///< what the palette starts with
  std::string file_for;      ///< the command that the file dialog asks a file for; empty: it is closed
  bool guide_open = true;    ///< what to do first; shown until a view is taken
  bool guide_asked = false;  ///< somebody wants to see it later than that, and however little room there is
  std::optional<EarlierSession> last_session;  ///< that it offers to go on with
  bool panels_hidden = false, full_screen = false;
  bool dark = false;                  ///< light on dark paper
  bool orthographic = false;          ///< the scene is drawn without vanishing points
  std::optional<std::string> manual;  ///< the topic of the page that is shown; none: it is closed
  PlaceSizes place_sizes;
  double text_scale = 1.0;  ///< of text and controls, beside the display's own
  bool quit = false;
  std::size_t dismissed_failure = 0;  ///< SessionSnapshot::failures of the message that was taken away
  Presentation presentation;          ///< what a demo shows

  Pose scene_camera = Pose::Identity();      ///< where the scene is looked at from; kept by the scene, as the next
  std::optional<Vector3> pointed_at;         ///< the point of what is shown that the pointer is at [m, world]
  std::vector<CameraMotion> camera_motions;  ///< to be made
  std::optional<PictureRequest> picture;     ///< to be drawn into a file
  std::string wanted_demo;                   ///< to be played in place of all that is shown; empty: none
  CommandHistory history;                    ///< the commands so far
  std::optional<DemoRecording> recording;    ///< of them

  bool shows_guide(const SessionSnapshot& session) const;
  /// The name of the panel in front; empty if there is none on this side.
  std::string in_front(Side side) const;
  /// @throws std::invalid_argument if there is no panel of this name.
  void bring_to_front(const std::string& panel);
};

}  // namespace nextview
