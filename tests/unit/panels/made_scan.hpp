#pragma once
#include "tests/unit/panels/desk.hpp"

namespace nextview {

/// A scan after two views with numbers made by hand, no two alike: what shows one in another's place shows another
/// text. Candidate 5 was taken and candidate 2 cannot be reached; their numbers are left over and larger than all.
inline std::shared_ptr<SessionSnapshot> made_scan() {
  static const auto scan = scanned(small_scan(), 2);
  auto s = std::make_shared<SessionSnapshot>(*scan);
  s->configuration.planner.gain = "occlusion-aware";
  s->gain_unit = "nats";
  StepRecord& r = s->records[1];
  r.view = 5;
  s->state.known.taken.at(1).wanted = s->state.candidates.at(5);
  r.overridden = false;
  r.gain = 12.5, r.gain_unit = "nats";
  r.utility = 0.375;
  r.realised_gain = 321;
  r.new_surface = 214;
  r.hits = 600;
  r.misses = 40;
  r.points = 500;
  r.new_voxels = 77;
  r.motion = {1.25, 1.5707963, 3};
  r.entropy = 4.5e6;
  r.total_entropy = 3.25e6;
  r.coverage = 0.375;
  r.coverage_visible = 0.625;
  r.coverage_paper = 0.125;
  r.quality.divergence = 7500;
  r.quality_near_surface.divergence = 1500;
  r.seconds = {0.25, 0.5, 1, 2, 4, 8};
  r.candidates = {{true, 10, 0.5, 0.01}, {true, 40, 0.25, 0.05}, {false, 9999, 99, 7},   {true, 20, 2, 0.02},
                  {true, 80, 1, -0.1},   {false, 8888, 98, 8},   {true, 160, 0.75, 0.2}, {true, 5, 1.5, -0.03}};
  r.ranking = {6, "", "Candidate 6: 214 cm² of new surface; 0.75 m away. Runner-up 3: 190 cm², 2 m."};
  s->next_candidate = 6;
  s->custom_next_view = false;
  s->finished.clear();
  return s;
}

}  // namespace nextview
