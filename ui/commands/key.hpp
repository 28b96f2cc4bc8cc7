#pragma once

namespace nextview {

/// Keys that mean something in the window; letters and digits are their upper-case characters.
enum class Key : int {
  space = ' ',
  tab = 256,
  enter,
  escape,
  backspace,
  del,
  left,
  right,
  up,
  down,
  home,
  end,
  page_up,
  page_down,
  control,
  shift,
  alt,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
  count
};
constexpr Key key(char character) { return static_cast<Key>(character); }

}  // namespace nextview
