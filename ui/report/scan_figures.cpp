#include "ui/report/scan_figures.hpp"

namespace nextview {

std::span<const ScanFigure> scan_figures() {
  static const std::vector<ScanFigure> all = {
      {"sensor",
       "Fig. 1: the sensor's frustum in the scene; Eq. 1, p(z | z_exp) of a range z where the first occupied voxel is "
       "at z_exp; and Eq. 2, which has the angle between the ray and the voxel's centre beside it and is no density.",
       sensor_figure},
      {"data_flow", "Fig. 3: what flows from room to room of the program in a step of Algorithm 2.", data_flow_figure},
      {"scene_and_octree",
       "Fig. 2: the object in the scene with the sensor that is about to look at it, and the octree of what was seen "
       "so far.",
       scene_and_octree_figure},
      {"candidate_views",
       "Fig. 4: all candidate views, coloured by how the planner first ranked them, with the numbers of those that "
       "were taken, as sentences and tables name them; and the views taken, numbered in their order, darker from "
       "view to view.",
       candidate_views_figure},
      {"strategy",
       "Fig. 5: the strategy view by view: rays cast from the view that is chosen next (colour: what they are expected "
       "to tell), the cloud so far, and the octree.",
       strategy_figure},
      {"maps",
       "Fig. 6: each object, its conventional octree, the octree of the Gibbs map of the same scans, and the aligned "
       "cloud; beneath, of an object whose openings are known, the one that is nearest to 20 mm wide, magnified. "
       "Blue: occupied; orange: measured, and still unknown.",
       maps_figure},
      {"gain_agreement",
       "Spearman's rank correlation between what gains say of the candidates on the same map, after a third of the "
       "views: 1 where two rank all views alike, -1 where in opposite order.",
       gain_agreement_figure},
  };
  return all;
}

}  // namespace nextview
