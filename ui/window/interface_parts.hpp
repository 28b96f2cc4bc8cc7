#pragma once
#include <memory>
#include <optional>
#include <tuple>

#include "ui/commands/script_recorder.hpp"
#include "ui/panels/all_panels.hpp"
#include "ui/window/asked_call.hpp"
#include "ui/window/camera_course.hpp"
#include "ui/window/compared_scene.hpp"
#include "ui/window/frame_composer.hpp"
#include "ui/window/imgui_host.hpp"
#include "ui/window/interface.hpp"
#include "ui/window/scene_pointer.hpp"
#include "ui/window/splitters.hpp"

namespace nextview {

/// ImGui's windows settle within a few frames.
constexpr int frames_to_settle = 3;

/// What is drawn in one frame; the next one may have other news.
struct News {
  std::shared_ptr<const SessionSnapshot> snapshot;
  WorkerProgress progress;
  std::shared_ptr<const Inspection> inspection;
  SessionLog::Told log;
  std::shared_ptr<const FoundSurface> surface;
  std::optional<SurfaceJob> surface_progress;

  bool operator==(const News&) const = default;
};

struct Interface::Parts {
  Parts(RenderTarget& s, SessionWorker& w, InspectionWorker& i, double scale)
      : target(s),
        worker(w),
        inspector(i),
        display_scale(scale),
        host(scale),
        view(s, scale),
        compared(s, scale),
        pictures(&s),
        composer(s),
        layout(1, 1, 1) {}

  RenderTarget& target;
  SessionWorker& worker;
  InspectionWorker& inspector;
  double display_scale;
  ImguiHost host;
  InputQueue queue;
  SceneView view;
  ComparedScene compared;
  ScenePointer pointer;
  Splitters splitters;
  PanelPictures pictures;
  FrameComposer composer;
  AllPanels panels;
  Layout layout;
  Side layout_open = Side::right;  ///< that the layout was made for, as the next
  bool layout_hidden = false;
  PlaceSizes layout_sizes;
  WindowState state;
  News news;
  AskedCall asked_call;
  std::filesystem::path offered;                    ///< a session to go on with
  std::uint64_t offer_request = 0;                  ///< that asks whether to
  std::uint64_t session = 0;                        ///< whose numbers the selection has
  std::string object;                               ///< that section and slice are of
  std::shared_ptr<const SessionSnapshot> asked_of;  ///< the last question
  Selection asked;
  std::optional<SurfaceQuestion> asked_surface;
  ScriptPlayer script;
  ScriptRecorder recorder{state.history};
  std::vector<std::pair<std::uint64_t, CommandCall>> behind_play;  ///< by their requests: given while views are played
  bool tooltip_is_due = false;                                     ///< in the last frame
  bool scripted = false;                                           ///< what was done in this frame
  bool camera_moved = false;                                       ///< by the user, since it was framed
  CameraMotion framing = camera_motion::Frame{};                   ///< the last one that framed something
  double motion_left = 0;                          ///< until what was drawn with less care is drawn well [s]; 0: it is
  double motion_began = 0;                         ///< in the operator's time [s]
  bool dragged = false;                            ///< by the pointer, since it was at rest
  std::optional<CameraCourse> course;              ///< of the flight that is under way
  WindowState before_demo;                         ///< of the last demo: what it borrows is given back
  bool layers_are_of_demo = false;                 ///< which has ended, and whose object is still there
  bool rested = false;                             ///< nothing ran at the begin of the last frame
  DrawingQuality quality = DrawingQuality::still;  ///< that the scene is drawn with
  bool scene_is_old = true;
  bool scene_waits = false;  ///< for the faces of a new map, and for a frame at least
  FacesAhead faces;
  std::size_t scene_drawings = 0;
  std::optional<std::tuple<float, float, std::size_t>> pointed_from;  ///< pointer, and which picture it was over
  int settling = frames_to_settle;
  std::optional<PictureSize> size_before;  ///< of the target, while a picture of the window is drawn in another size

  News latest() const {
    return {worker.snapshot(),   worker.progress(),   inspector.answer(),
            worker.log().told(), inspector.surface(), inspector.surface_progress()};
  }
  bool works() const;
  bool at_rest() const;
  bool shows_captions() const {
    const Presentation& p = state.presentation;
    return p.captioned || p.caption || p.paused;
  }
  bool script_may_go_on() const;
  void pass_time(double seconds);
  void fly(double seconds);
  std::vector<InputEvent> input_beside_demo(const std::vector<InputEvent>& events);
  void begin_demo(std::vector<CommandCall> calls);
  void give_back();
  void take_over();
  void leave_layers_of_demo();
  void play(const std::string& demo);
  void record(const CommandCall& call, std::uint64_t request, bool playing);
  void record_done();
  void record_drag();
  void take_news();
  void take_input();
  /// Pixels of the window a pixel of the design.
  double scale() const;
  bool layout_is_old() const;
  void follow_scale();
  void follow_size();
  void share_scene();
  void follow_session();
  void draw_interface(double seconds);
  void follow_tooltip();
  void point_at(const ImVec2& mouse);
  void do_calls(std::vector<CommandCall> calls);
  void do_call(const CommandCall& call);
  void do_for_people(const CommandCall& call);
  void follow_pointer(const PanelContext& context, double seconds);
  void move_camera();
  void draw_fast(DrawingQuality quality);
  void bring_to_rest();
  void ask_inspector();
  void ask_surface();
  bool by_hand() const;
  bool script_goes_on() const;
  bool draw_scene();
  /// Of the session's worker, or of the turntable that is drawn.
  WorkerProgress progress() const;
  void draw_wanted_picture();
  void take_picture_size();
  void leave_picture_size();
  void write_window_picture();

 private:
  Image draw_window();
  void draw_apart();
  void draw_next_frame();
  void draw_curves() const;
  void write_wanted(const Image& image, const std::filesystem::path& file) const;
  void picture_failed(const std::string& reason);
};

}  // namespace nextview
