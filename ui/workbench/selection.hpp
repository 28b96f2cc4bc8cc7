#pragma once
#include <cstdint>
#include <optional>

#include "core/view/pose.hpp"

namespace nextview {

/// The view that the view panel shows and that rays are drawn of.
struct ViewSelection {
  enum class Kind { next, candidate, taken, custom };
  Kind kind = Kind::next;
  std::size_t index = 0;  ///< of the candidate, or of the step, from 0

  bool operator==(const ViewSelection&) const = default;
  bool is(Kind k, std::size_t i) const { return kind == k && index == i; }
};

/// What the user has picked.
struct Selection {
  ViewSelection view;
  std::optional<std::uint32_t> voxel;
  std::optional<std::size_t> ray;   ///< of the view that is looked at
  std::optional<Pose> custom_view;  ///< T_world_camera of a custom view, before it is taken

  std::optional<std::size_t> candidate() const {
    return view.kind == ViewSelection::Kind::candidate ? std::optional(view.index) : std::nullopt;
  }
  bool operator==(const Selection& other) const {
    const bool same_custom_view =
        custom_view ? other.custom_view && custom_view->isApprox(*other.custom_view) : !other.custom_view;
    return view == other.view && voxel == other.voxel && ray == other.ray && same_custom_view;
  }
};

}  // namespace nextview
