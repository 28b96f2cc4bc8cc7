#include "ui/window/input.hpp"

#include <algorithm>

namespace nextview {

void InputQueue::push(InputEvent event) { waiting_.push_back(std::move(event)); }

std::vector<InputEvent> InputQueue::take_frame() {
  const auto is_move = [](const InputEvent& event) { return std::holds_alternative<input::Move>(event); };
  auto end = std::find_if_not(waiting_.begin(), waiting_.end(), is_move);
  if (end != waiting_.end()) ++end;
  std::vector<InputEvent> frame(waiting_.begin(), end);
  waiting_.erase(waiting_.begin(), end);
  return frame;
}

}  // namespace nextview
