#pragma once
#include <filesystem>
#include <variant>
#include <vector>

#include "ui/commands/key.hpp"

namespace nextview {

enum class PointerButton { left, right, middle };

/// What the user does, in the order in which it is done.
namespace input {

struct Move {
  double x, y;  ///< framebuffer pixels from the upper left corner
};
struct Button {
  PointerButton button;
  bool down;
};
struct Wheel {
  double steps;  ///< away from the user is positive
};
struct KeyChange {
  Key key;
  bool down;
};
struct Text {
  unsigned int character;  ///< Unicode
};
struct Drop {
  std::filesystem::path file;  ///< the first
  std::size_t count = 1;       ///< of all that were dropped together
};
struct Expose {};  ///< the display needs the picture again

}  // namespace input

using InputEvent =
    std::variant<input::Move, input::Button, input::Wheel, input::KeyChange, input::Text, input::Drop, input::Expose>;

/// Input that waits for the next frame. ImGui sees the state at the beginning of a frame only, so a press and a release
/// in the same frame would be lost: a frame takes moves, then at most one of everything else.
class InputQueue {
 public:
  void push(InputEvent event);
  bool empty() const { return waiting_.empty(); }
  /// What the next frame may see, in order.
  std::vector<InputEvent> take_frame();

 private:
  std::vector<InputEvent> waiting_;
};

}  // namespace nextview
