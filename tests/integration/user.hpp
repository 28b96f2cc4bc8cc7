#pragma once
#include <chrono>
#include <functional>
#include <thread>

#include "ui/commands/script.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/window/interface.hpp"

namespace nextview {

/// The window of 1280 x 800 at half its size: a software renderer takes its time for each pixel. For what counts no
/// pixels of a panel.
inline constexpr int half_width = 640, half_height = 400;
inline constexpr double half_scale = 0.5;

/// Somebody in front of the window, who needs no display: input goes in, pictures come out. Time is what the frames
/// say.
class User {
 public:
  explicit User(const Configuration& configuration, int width = 1280, int height = 800, double scale = 1.0)
      : target_(width, height), interface_(target_, worker_, inspector_, scale) {
    interface_.open(configuration);
    wait_for_news();  // most look at a picture only once they have done something
  }

  /// Looks at frames until nothing new comes and both workers are idle, or a refinement is paused, and all edges are
  /// smooth. A script that waits (command::wait) has its time.
  void wait() {
    wait_for_news();
    while (!interface_.is_drawn_well() || !interface_.is_still()) interface_.draw(frame);
  }
  /// Edges may be rough yet: to draw them takes a software renderer longer than most commands.
  void wait_for_news() {
    constexpr auto pause = std::chrono::milliseconds(2);
    while (!interface_.is_still() || !interface_.script_is_done()) {
      const WorkerProgress progress = worker_.progress();
      const bool works = (progress.busy && !progress.paused) || inspector_.busy();
      if (works && interface_.seconds_to_next_frame() > 0.0) {
        std::this_thread::sleep_for(pause);
      } else {
        interface_.draw(frame);
      }
    }
  }

  /// Looks for as long as it takes to read a question; Enter answers none before.
  void read_question() {
    for (int i = 0; i < 30; ++i) interface_.draw(frame);
  }

  void move(double x, double y) { interface_.push(input::Move{x, y}); }
  void press(PointerButton button = PointerButton::left) { interface_.push(input::Button{button, true}); }
  void release(PointerButton button = PointerButton::left) { interface_.push(input::Button{button, false}); }
  /// Everything arrives before the next frame, as from a fast hand.
  void click(double x, double y) {
    move(x, y);
    press();
    release();
  }
  void type(Key key) {
    interface_.push(input::KeyChange{key, true});
    interface_.push(input::KeyChange{key, false});
  }
  void write(const std::string& text) {
    for (const char c : text) interface_.push(input::Text{static_cast<unsigned char>(c)});
  }
  /// Does the lines of a script and waits for what comes of them.
  void run(std::string_view script) {
    interface_.run_script(parse_script(script));
    wait();
  }
  /// Likewise, as somebody does who is in a hurry: with rough edges.
  void run_quickly(std::string_view script) {
    interface_.run_script(parse_script(script));
    wait_for_news();
  }
  void drop(const std::filesystem::path& file, std::size_t count = 1) { interface_.push(input::Drop{file, count}); }

  Image look() { return target_.read_back(); }
  const SessionSnapshot& session() {
    seen_ = worker_.snapshot();
    return *seen_;
  }
  Interface& window() { return interface_; }
  RenderTarget& target() { return target_; }
  SessionWorker& worker() { return worker_; }

 private:
  static constexpr double frame = 1.0 / 60;  // [s]

  OffscreenTarget target_;
  SessionWorker worker_;
  InspectionWorker inspector_;
  Interface interface_;
  std::shared_ptr<const SessionSnapshot> seen_;
};

}  // namespace nextview
