#include "core/calibration/slant_fit.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

/// Views all around two maps; what they show is left open.
std::vector<ShownByViews> made_up_states() {
  std::mt19937 random(4);
  const RayBundle bundle = RayBundle::regular(PinholeCamera::from_field_of_view(160, 120, 1.0), 12, 9);
  std::vector<ShownByViews> states;
  for (const double unmeasured : {0.3, 0.6}) {
    const auto made = evidence_maps::random_map(random, Eigen::Vector3i::Constant(20), 0.1, unmeasured);
    ShownByViews& state = states.emplace_back(ShownByViews{made.evidence(), bundle, 1.5, 900.0, {}, {}});
    for (const Vector3& from : {Vector3(0.8, 0.1, 0.1), Vector3(0.1, 0.5, 0.7), Vector3(-0.5, -0.6, 0.2)})
      state.views.push_back(look_at(from, Vector3::Zero()));
  }
  return states;
}

void show(std::vector<ShownByViews>& states, const NewSurfaceModel& model, const SurfaceSlant& slant) {
  for (ShownByViews& state : states)
    state.areas = expected_new_surface({state.evidence, model}, state.views, state.bundle, {state.ray_length, slant});
}

/// Of all views alike.
SurfaceSlant fitted_slant(const NewSurfaceModel& model, const std::vector<ShownByViews>& states) {
  SlantFit fit(model);
  for (const ShownByViews& state : states) fit.add(state);
  return fit.fit().times(1.0 / SlantFit::views_taken_show);
}

TEST(SlantFit, GivesTheSlantsBackThatWerePlanted) {
  std::vector<ShownByViews> states = made_up_states();
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  show(states, model, {2.5, 0.75});
  const SurfaceSlant fitted = fitted_slant(model, states);
  EXPECT_NEAR(fitted.edge_on, 2.5, 1e-6);
  EXPECT_NEAR(fitted.face_on, 0.75, 1e-6);
}

TEST(SlantFit, ErrorsAreSharesOfTheObject) {
  std::vector<ShownByViews> states = made_up_states();
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  show(states, model, {2.0, 2.0});
  for (double& area : states[1].areas) area *= 1.5;
  EXPECT_GT(fitted_slant(model, states).edge_on, 2.0);
  states[1].surface *= 1e6;  // a huge object, of which all that is seen is next to nothing
  EXPECT_NEAR(fitted_slant(model, states).edge_on, 2.0, 1e-3);
}

TEST(SlantFit, StaysInItsBounds) {
  std::vector<ShownByViews> states = made_up_states();
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  show(states, model, {50.0, -3.0});
  const SurfaceSlant fitted = fitted_slant(model, states);
  EXPECT_DOUBLE_EQ(fitted.edge_on, SurfaceSlant::most / SlantFit::views_taken_show);
  EXPECT_EQ(fitted.face_on, SurfaceSlant::least);
}

TEST(SlantFit, NothingToLearnFromIsRefused) {
  EXPECT_THROW(SlantFit(NewSurfaceModel::fitted()).fit(), std::invalid_argument);
}

TEST(SlantFit, SameOnAnyNumberOfThreads) {
  std::vector<ShownByViews> states = made_up_states();
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  show(states, model, {2.5, 0.75});
  for (double& area : states[0].areas) area += 3.0;
  const SurfaceSlant many = fitted_slant(model, states);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(fitted_slant(model, states), many);
}

}  // namespace
}  // namespace nextview
