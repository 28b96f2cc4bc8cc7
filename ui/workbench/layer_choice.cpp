#include "ui/workbench/layer_choice.hpp"

namespace nextview {

LayerChoice LayerChoice::of_second() const {
  LayerChoice other = *this;
  other.object = second == SecondView::object;
  other.surface = second == SecondView::surface;
  other.cloud = second == SecondView::cloud;
  other.octree = second == SecondView::octree || second == SecondView::gibbs;
  other.missed = second == SecondView::missed;
  if (second == SecondView::octree) other.map = MapChoice::conventional;
  if (second == SecondView::gibbs) other.map = MapChoice::gibbs;
  if (second == SecondView::object) other.object_style = MeshStyle::solid;
  other.views = other.rays = other.region = false;
  return other;
}

}  // namespace nextview
