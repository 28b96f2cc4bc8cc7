#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/render/render_test.hpp"
#include "tests/render/samples.hpp"
#include "ui/render_target/offscreen_target.hpp"

/// What the layers' colours and legends say, by pixels and by words.
namespace nextview {
namespace {

const float none = std::nanf("");

Voxel voxel(float p) { return {p, float(entropy(p)), InverseSensorModel{}.classify(p), true, 0}; }

void expect_near(const Colour& a, const Colour& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.01);
}

TEST(VoxelPalette, ColoursFollowTheirMaps) {
  const VoxelPalette entropies(VoxelColouring::by_entropy), differences(VoxelColouring::by_difference),
      errors(VoxelColouring::by_error), probabilities(VoxelColouring::by_probability),
      classes(VoxelColouring::by_class);
  expect_near(*entropies.colour(voxel(0.5f), none), ColourMap::uncertainty().at(1.0));
  expect_near(*entropies.colour(voxel(0.97f), none), ColourMap::uncertainty().at(entropy(0.97) / std::numbers::ln2));
  expect_near(*differences.colour(voxel(0.9f), -1.0f), ColourMap::deviation().at(0.0));
  expect_near(*differences.colour(voxel(0.9f), 0.5f), ColourMap::deviation().at(0.75));
  expect_near(*errors.colour(voxel(0.1f), 0.25f), ColourMap::error().at(0.25));
  expect_near(*errors.colour(voxel(0.1f), 7.0f), ColourMap::error().at(1.0));
  expect_near(*probabilities.colour(voxel(0.3f), none), ColourMap::probability().at(0.3));
  expect_near(*classes.colour(voxel(0.1f), none), theme::free);
  expect_near(*classes.colour(voxel(0.5f), none), theme::unknown);
  EXPECT_FALSE(errors.colour(voxel(0.1f), none).has_value());
}

TEST(OctreeLayer, LegendsSayWhatTheEndsMeanAndWhatHasNoValue) {
  draw_scene(64, 64, [](Scene& scene) {
    const auto map = samples::map(samples::usual_viewer);
    std::vector<float> values(map.voxels.size(), 0.2f);
    const auto legend = [&](VoxelColouring colouring) {
      scene.octree().set_colouring(colouring, values);
      return scene.octree().legends()[0];
    };
    scene.octree().show(map.grid, map.voxels);
    EXPECT_NEAR(legend(VoxelColouring::by_entropy).range->high, std::numbers::ln2, 1e-12);
    EXPECT_EQ(legend(VoxelColouring::by_entropy).range->unit, "nats");
    EXPECT_EQ(legend(VoxelColouring::by_difference).range->low, -1.0);
    EXPECT_TRUE(legend(VoxelColouring::by_difference).swatches.empty()) << "all have values";
    values.assign(values.size(), none);
    EXPECT_EQ(legend(VoxelColouring::by_difference).swatches.at(0).name, "no value");
    EXPECT_EQ(legend(VoxelColouring::by_error).swatches.at(0).name, "no truth");
    EXPECT_TRUE(legend(VoxelColouring::by_entropy).swatches.empty()) << "needs no values";
    values.pop_back();
    EXPECT_THROW(legend(VoxelColouring::by_error), std::invalid_argument);
    EXPECT_THROW(scene.octree().show(map.grid, map.voxels, {}, VoxelColouring::by_error, values),
                 std::invalid_argument);
  });
}

TEST(OctreeLayer, OtherValuesLaterDrawTheSameAsAtOnce) {
  const auto map = samples::map(samples::usual_viewer);
  const auto errors = samples::errors(map), differences = samples::differences(map);
  OffscreenTarget target(320, 200);
  const auto draw = [&](bool later) {
    return draw_scene(target, [&](Scene& scene) {
      scene.octree().show(map.grid, map.voxels, {true, true, true}, VoxelColouring::by_error,
                          later ? differences : errors);
      if (later) {
        scene.frame();
        scene.octree().set_colouring(VoxelColouring::by_difference, differences);
        scene.octree().set_colouring(VoxelColouring::by_error, errors);
      }
      scene.frame();
    });
  };
  const Image at_once = draw(false);
  EXPECT_EQ(draw(true), at_once);
}

TEST(CloudLayer, LegendsAndRefusals) {
  draw_scene(64, 64, [](Scene& scene) {
    const std::vector<Eigen::Vector3f> points{{0, 0, 0.1f}, {0, 0.1f, 0.3f}, {0.1f, 0, 0.2f}};
    const std::vector<std::uint16_t> views{0, 2, 6};
    const std::vector<float> distances{0.001f, 0.2f, none};
    CloudPicture picture{points, views, distances, CloudColouring::by_view};
    const auto legend = [&] {
      scene.cloud().show(picture);
      return scene.cloud().legends()[0];
    };
    EXPECT_EQ(legend().range->high, 7.0) << "people count views from 1";
    picture.colouring = CloudColouring::by_height;
    EXPECT_NEAR(legend().range->low, 0.1, 1e-6);
    EXPECT_FALSE(legend().locked);
    picture.heights = ValueRange{0.0, 0.25};
    EXPECT_TRUE(legend().locked);
    EXPECT_EQ(legend().range->high_name, "and more");
    picture.colouring = CloudColouring::by_distance;
    EXPECT_EQ(legend().range->high, 5.0);
    EXPECT_EQ(legend().range->unit, "mm");
    EXPECT_EQ(legend().swatches.at(0).name, "no truth");
    picture.distances = {};
    EXPECT_THROW(legend(), std::invalid_argument) << "nothing to colour by";
    picture.colouring = CloudColouring::by_view;
    picture.views = std::span(views).first(2);
    EXPECT_THROW(legend(), std::invalid_argument) << "too few";
  });
}

TEST(ViewsLayer, ALockedRangeKeepsItsColoursAndSaysSo) {
  draw_scene(64, 64, [](Scene& scene) {
    const auto candidates = samples::candidates();
    const std::vector<double> scores(candidates.size(), 30.0);
    ViewsPicture picture;
    picture.camera = PinholeCamera::from_field_of_view(64, 48, 1.0);
    picture.candidates = candidates;
    picture.scores = scores;
    picture.custom_view = look_at(samples::usual_viewer, Vector3::Zero());
    scene.views().show(picture);
    EXPECT_FALSE(scene.views().legends()[0].locked);
    EXPECT_EQ(scene.views().legends()[1].swatches.at(0).name, "custom view");
    EXPECT_EQ(scene.views().labels()[0].text, "custom view");
    picture.range = ValueRange{0.0, 20.0};
    scene.views().show(picture);
    EXPECT_TRUE(scene.views().legends()[0].locked);
    EXPECT_EQ(scene.views().legends()[0].range->high, 20.0);
    EXPECT_EQ(scene.views().legends()[0].range->high_name, "and more");
    picture.range = ValueRange{1.0, 1.0};
    EXPECT_THROW(scene.views().show(picture), std::invalid_argument);
    scene.rays().show(samples::rays(*picture.custom_view), {"entropy", "nats", 0.1});
    EXPECT_TRUE(scene.rays().legends()[0].locked);
    EXPECT_EQ(scene.rays().legends()[0].range->high, 0.1);
  });
}

TEST(ViewsLayer, AScaleIsExplainedWhereACandidateHasItsColours) {
  draw_scene(64, 64, [](Scene& scene) {
    const auto candidates = samples::candidates();
    const std::vector<double> scores(candidates.size(), 30.0);
    std::vector<std::size_t> hidden;
    for (std::size_t i = 1; i < candidates.size(); ++i) hidden.push_back(i);
    ViewsPicture picture;
    picture.camera = PinholeCamera::from_field_of_view(64, 48, 1.0);
    picture.candidates = candidates;
    picture.scores = scores;
    picture.hidden = hidden;
    scene.views().show(picture);
    EXPECT_EQ(scene.views().legends().front().title, picture.score_name);
    picture.chosen = 0;
    scene.views().show(picture);
    EXPECT_EQ(scene.views().legends().front().title, "views") << "the only one that is drawn is the chosen one";
    const std::array<std::size_t, 1> taken{0};
    picture.chosen.reset(), picture.taken = taken;
    scene.views().show(picture);
    EXPECT_EQ(scene.views().legends().front().title, "views") << "the only one that is drawn was taken";
  });
}

/// A square that fills the picture of 300 x 300 pixels, its corners of these classes, and how many pixels have which
/// colour.
std::map<std::array<int, 3>, int> colours_of_square(RenderTarget& target, const std::vector<std::uint8_t>& classes) {
  const Image image = draw_scene(target, [&](Scene& scene) {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    scene.set_axes(false, false);
    scene.set_legends(false);
    scene.mesh().show(square, MeshClasses{classes, {{"a", {0.8, 0.2, 0.2}}, {"b", {0.2, 0.8, 0.2}}, {"c", {0, 0, 1}}}});
    scene.frame({-90, 0});
  });
  std::map<std::array<int, 3>, int> result;
  for (int y = 60; y < 240; ++y) {
    for (int x = 60; x < 240; ++x) {
      const std::uint8_t* pixel = &image.rgba[(std::size_t(y) * 300 + x) * 4];
      ++result[{pixel[0], pixel[1], pixel[2]}];
    }
  }
  return result;
}

TEST(MeshLayer, ClassesDoNotMix) {
  OffscreenTarget target(300, 300);
  std::vector<std::array<int, 3>> pure;
  for (const std::uint8_t one : {0, 1, 2}) {
    const auto colours = colours_of_square(target, {one, one, one, one});
    ASSERT_EQ(colours.size(), 1u) << "flat and lit evenly";
    pure.push_back(colours.begin()->first);
  }
  const auto colours = colours_of_square(target, {0, 1, 2, 0});
  int clear = 0;
  for (const auto& [colour, pixels] : colours)
    if (std::find(pure.begin(), pure.end(), colour) != pure.end()) clear += pixels;
  EXPECT_GT(clear, 0.97 * 180 * 180) << "all but the pixels on the borders";
  for (const auto& colour : pure) EXPECT_GT(colours.at(colour), 0.1 * 180 * 180);
}

TEST(MeshLayer, ClassesThatDoNotFitAreRefused) {
  draw_scene(64, 64, [](Scene& scene) {
    const auto mesh = samples::torus();
    std::vector<std::uint8_t> classes(mesh.vertices.size(), 1);
    EXPECT_THROW(scene.mesh().show(mesh, MeshClasses{classes, {{"one", theme::object}}}), std::invalid_argument);
    EXPECT_THROW(scene.mesh().show(mesh, MeshClasses{classes, {}}), std::invalid_argument);
    scene.mesh().show(mesh, MeshClasses{classes, {{"one", theme::object}, {"two", theme::missed}}});
    ASSERT_EQ(scene.mesh().legends()[0].swatches.size(), 1u) << "only what there is";
    EXPECT_EQ(scene.mesh().legends()[0].swatches[0].name, "two");
    classes.pop_back();
    EXPECT_THROW(scene.mesh().show(mesh, MeshClasses{classes, {{"one", theme::object}, {"two", theme::missed}}}),
                 std::invalid_argument);
  });
}

}  // namespace
}  // namespace nextview
