#pragma once
#include <functional>
#include <memory>
#include <string>

#include "ui/commands/command.hpp"
#include "ui/commands/script_player.hpp"
#include "ui/render_target/render_target.hpp"
#include "ui/window/clipboard.hpp"
#include "ui/window/input.hpp"
#include "ui/window/scene_view.hpp"
#include "ui/window/window_preferences.hpp"
#include "ui/workbench/inspection_worker.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {

/// Everything in the window: scene and panels. It draws into any target and knows nothing of where input comes from,
/// so tests drive it without a display. There is one at a time.
class Interface {
 public:
  /// `scale` is the display's. Surface and workers must live longer.
  Interface(RenderTarget& target, SessionWorker& worker, InspectionWorker& inspector, double scale = 1.0);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Gives the target another context (RenderTarget::renew), with all that was in the old one: the window is drawn as
  /// before. @throws as that
  void renew_target();
  void set_clipboard(Clipboard clipboard);
  void push(const InputEvent& event);
  /// Has the worker begin with this configuration. A script that is saved begins with it, too.
  void open(const Configuration& configuration);
  /// The same with the folder of a session, to go on with it.
  void open_session(const std::filesystem::path& folder);
  /// The same with a live scanner.
  void connect(const request::Connect& scanner);
  /// Offers to go on with a session that nobody closed.
  void offer(const EarlierSession& session);
  /// Does these calls one after the other, each when the one before has had its effect.
  void run_script(std::vector<CommandCall> calls);
  /// Records all that is done from now on, until it is ended by command or stop_recording(). The file ends in
  /// .nextview.
  /// @throws std::runtime_error naming the file if it cannot be written.
  void record(const std::string& file);
  void stop_recording();  ///< if there is one. @throws likewise
  /// The same as a demo: with its own time, and the keyboard to pause, to skip and to take over.
  void play_demo(std::vector<CommandCall> calls);
  bool script_is_done() const;  ///< or the window is about to close: what is left of it is not done
  ScriptPlayer& script();
  /// How long after the last frame another one would look different, if there is no input and no news [s]. 0: at once.
  double seconds_to_next_frame() const;
  /// Nothing runs (a refinement may be paused), and what came of it is drawn: until time passes or somebody does
  /// something, no frame differs.
  bool is_still() const;
  /// What is asked for by hand is drawn with less care at first; whether the scene has been drawn well since.
  bool is_drawn_well() const;
  /// Draws a frame into the target's back buffer, `seconds` after the last one, and returns whether it differs from
  /// the last one; if not, the back buffer is left alone. The scene is drawn anew only if it changed.
  bool draw(double seconds);

  /// Does what a person wants, who is asked first if it costs something.
  void ask(const CommandCall& call);
  /// The window is to be closed; who wants that a second time means it.
  void ask_to_quit();
  /// That waits for an answer; empty if none does.
  std::string question() const;
  bool wants_to_quit() const;
  /// What was kept of the window before: to be told before a demo is played.
  void set_preferences(const WindowPreferences& preferences);
  /// To be kept for the next window. While a demo plays, those that it gives back at its end.
  WindowPreferences preferences() const;
  void show_guide(bool show);
  /// Shows with the guide what was scanned last, to go on with it.
  void set_last_session(std::optional<EarlierSession> session);
  /// "Nextview - gearbox - view 3 of 20"
  std::string title() const;
  /// What is shown; tests look here for where things are.
  const Layout& layout() const;
  const WindowState& state() const;
  SceneView& scene();
  /// How often the scene was drawn.
  std::size_t scene_drawings() const;
  /// How much of the window was drawn again in the last frame [px].
  std::size_t pixels_drawn() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace nextview
