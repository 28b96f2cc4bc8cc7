#pragma once
#include "core/surface/surface.hpp"

namespace nextview {

/// The triangles whose three corners are seen; all vertices. @pre there is a mark for every vertex.
TriangleMesh seen_part(const Surface& surface);
/// The others, which close the surface where no view has looked; all vertices. @pre as above.
TriangleMesh unseen_part(const Surface& surface);
/// The same two as surfaces of their own, with the vertices that they need.
Surface seen_surface(const Surface& surface);
Surface unseen_surface(const Surface& surface);

struct SeenArea {
  double seen = 0.0, unseen = 0.0;  ///< [m^2]
  /// For people: one of the two as "0.061 m²"; in m², cm² or mm², as their sum asks for.
  std::string text(double area) const;
  /// For people: "21 %"; only nothing is called 0 %, and only the whole 100 %.
  std::string percent_seen() const;
};
SeenArea seen_area(const Surface& surface);

}  // namespace nextview
