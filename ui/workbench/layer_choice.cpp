#include "ui/workbench/layer_choice.hpp"

#include <utility>

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

void LayerChoice::show_alone(bool LayerChoice::*which, bool shown) {
  if (!missed && !surface) cloud_before = cloud, octree_before = octree;
  missed = surface = false;
  this->*which = shown;
  if (shown)
    cloud = octree = false;
  else if (!cloud && !octree)  // what was switched on meanwhile stays
    cloud = cloud_before, octree = octree_before;
}

void LayerChoice::follow_comparison(bool compared) {
  if (compared && surface) {
    show_alone(&LayerChoice::surface, false);
    surface_aside = true;
  } else if (!compared && std::exchange(surface_aside, false)) {
    show_alone(&LayerChoice::surface, true);
  }
}

}  // namespace nextview
