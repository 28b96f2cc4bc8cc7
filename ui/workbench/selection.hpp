#pragma once
#include <cstdint>
#include <optional>

#include "core/view/pose.hpp"

namespace nextview {

/// The view that the view panel shows and that rays are drawn of.
struct LookedAt {
  enum class Kind { next, candidate, taken, own };
  Kind kind = Kind::next;
  std::size_t index = 0;  ///< of the candidate, or of the step, from 0

  bool operator==(const LookedAt&) const = default;
  bool is(Kind k, std::size_t i) const { return kind == k && index == i; }
};

/// What a person has picked.
struct Selection {
  LookedAt view;
  std::optional<std::uint32_t> voxel;
  std::optional<std::size_t> ray;  ///< of the view that is looked at
  std::optional<Pose> own_view;    ///< T_world_camera of a view of one's own, before it is taken

  std::optional<std::size_t> candidate() const {
    return view.kind == LookedAt::Kind::candidate ? std::optional(view.index) : std::nullopt;
  }
  bool operator==(const Selection& other) const {
    const bool same_own_view = own_view ? other.own_view && own_view->isApprox(*other.own_view) : !other.own_view;
    return view == other.view && voxel == other.voxel && ray == other.ray && same_own_view;
  }
};

}  // namespace nextview
