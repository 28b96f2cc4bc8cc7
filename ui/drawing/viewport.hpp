#pragma once

namespace nextview {

/// A part of a render target, as shares of its width and height from the lower left corner.
struct Viewport {
  double left = 0.0, bottom = 0.0, right = 1.0, top = 1.0;
};

}  // namespace nextview
