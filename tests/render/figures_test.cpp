#include <cmath>

#include "tests/render/render_test.hpp"
#include "tests/render/samples.hpp"
#include "ui/figures/step_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

ChartSeries curve(const std::string& name, double start, double end, double rate, int views) {
  ChartSeries series{name, {}, {}};
  for (int i = 0; i <= views; ++i) {
    series.x.push_back(i);
    series.y.push_back(end + (start - end) * std::exp(-rate * i));
  }
  return series;
}

StepPicture step(const TriangleMesh& object, const samples::Map& map, const Vector3& viewer) {
  StepPicture picture;
  picture.step = 3;
  picture.step_count = 20;
  picture.object_name = "torus, 0.5 m";
  picture.gain_name = "occlusion aware";
  picture.gain_unit = "nats";
  picture.object = &object;
  picture.grid = map.grid;
  picture.voxels = map.voxels;
  picture.cloud = samples::cloud(viewer);
  picture.camera = PinholeCamera::from_field_of_view(640, 480, 1.0123);
  picture.candidates = samples::candidates();
  picture.scores = samples::scores(picture.candidates, viewer);
  for (std::size_t i = 0; i < picture.scores.size(); ++i) picture.utilities.push_back(picture.scores[i] / 50e3 - 0.01);
  picture.taken = {36, 22};
  picture.path = {look_at(viewer, Vector3::Zero()), picture.candidates[36], picture.candidates[22]};
  for (std::size_t i = 0; i < picture.scores.size(); ++i) {
    if (!picture.chosen || picture.scores[i] > picture.scores[*picture.chosen]) picture.chosen = i;
  }
  picture.rays = samples::rays(picture.candidates[*picture.chosen]);
  picture.ray_values = {"entropy along rays", "nats"};
  picture.entropy.series = {curve("Nextview", 2.1e6, 1.3e5, 0.5, 8), curve("random views", 2.1e6, 4.1e5, 0.3, 8)};
  picture.coverage.series = {curve("all surface", 0, 84, 0.5, 8), curve("visible surface", 0, 99, 0.5, 8)};
  return picture;
}

TEST(Figures, StepFigure) {
  const TriangleMesh object = samples::torus();
  const samples::Map map = samples::map(samples::usual_viewer);
  expect_screenshot("step_figure", draw_step_figure(step(object, map, samples::usual_viewer)));
}

TEST(Figures, Chart) {
  OffscreenTarget target(720, 420);
  Chart chart;
  chart.attach(target);
  ChartContent content{"Entropy of the map", "view", "", "entropy", "bits", {}, {}, true};
  content.series = {curve("occlusion aware", 2.1e6, 1.3e5, 0.5, 20), curve("random views", 2.1e6, 4.1e5, 0.3, 20),
                    curve("fixed order", 2.1e6, 6.0e5, 0.2, 20)};
  chart.show(content);
  target.render();
  expect_screenshot("chart", target.read_back());
  EXPECT_EQ(target.gl_error(), 0u);
}

}  // namespace
}  // namespace nextview
