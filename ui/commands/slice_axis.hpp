#pragma once

namespace nextview {

/// Across which a slice, or a section, is.
enum class SliceAxis { none, x, y, z };

}  // namespace nextview
