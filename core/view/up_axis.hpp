#pragma once
#include "core/view/pose.hpp"

namespace nextview {

/// Which axis of a file's coordinates points up. `automatic`: y where its type says so (glTF, X3D), else z.
enum class UpAxis { automatic, z, y, x, minus_z, minus_y, minus_x };

/// A file's coordinates turned so that z, the world's, is up: to the digit, for only axes change places. `automatic` is
/// z.
inline Vector3 with_z_up(UpAxis up, const Vector3& p) {
  switch (up) {
    case UpAxis::y:
      return {p.x(), -p.z(), p.y()};
    case UpAxis::x:
      return {-p.z(), p.y(), p.x()};
    case UpAxis::minus_z:
      return {p.x(), -p.y(), -p.z()};
    case UpAxis::minus_y:
      return {p.x(), p.z(), -p.y()};
    case UpAxis::minus_x:
      return {p.z(), p.y(), -p.x()};
    default:
      return p;
  }
}

}  // namespace nextview
