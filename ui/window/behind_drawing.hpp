#pragma once

namespace nextview {

/// From now on the thread that calls this, and those that TBB lends it, leave the processor to threads that draw: a
/// window follows the hand while a step is under way. They get what is left, which is nearly all where nothing is
/// drawn. The main thread stays as it is. May be called often.
void stay_behind_drawing();

}  // namespace nextview
