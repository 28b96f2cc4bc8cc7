#include "core/session/setup_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Of a sphere with a radius of 0.25 m, all of whose distances are known.
std::vector<std::string> of_the_sphere(const Configuration& c) {
  return setup_warnings(c, sphere_part().mesh, candidate_views(c.views, Vector3::Zero()));
}

TEST(SetupWarnings, ThereAreNoneOfWhatComesWithTheProgram) {
  const auto configurations = assets_folder() / "configurations";
  for (const char* name : {"gearbox", "bunny", "slotted_plate", "slotted_housing", "sphere", "box"}) {
    const auto object = load_mesh(resolve_object(name));
    for (const char* preset : {"paper", "narrow", "wide"})
      for (const char* file : {"", "paper.toml", "calibrated.toml"}) {
        Configuration c;
        if (*file) c = read_configuration(configurations / file);
        apply_sensor_preset(c, preset);
        for (const ViewLayout layout : {ViewLayout::sphere, ViewLayout::hemisphere, ViewLayout::rings}) {
          c.views.layout = layout;
          EXPECT_THAT(setup_warnings(c, object, candidate_views(c.views, Vector3::Zero())), IsEmpty())
              << name << " " << preset << " " << file;
        }
      }
  }
}

TEST(SetupWarnings, CamerasInsideTheObject) {
  Configuration c;
  c.views.radius = 0.2;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("49 of 49 views"), HasSubstr("inside the object"),
                                                  HasSubstr("views.radius (200 mm)"), HasSubstr("it reaches 4"))));
}

TEST(SetupWarnings, VoxelsAreProposedAsFineAsThereAreAny) {
  Configuration c;
  const auto of_size = [&](float factor) {
    TriangleMesh small = sphere_part().mesh;  // half a metre large
    for (Eigen::Vector3f& vertex : small.vertices) vertex *= factor;
    return setup_warnings(c, small, {});
  };
  EXPECT_THAT(of_size(0.01f), Contains(HasSubstr("map.resolution, for example to 0.1 mm")));
  EXPECT_THAT(of_size(0.0005f), Contains(HasSubstr("map.resolution, for example to 0.01 mm")));
  EXPECT_THAT(of_size(0.00005f),
              Contains(HasSubstr("none are finer than 0.01 mm, so scan it larger: object.longest_side")));
}

TEST(SetupWarnings, AViewsFileThatIsNotRead) {
  Configuration c;
  c.views.file = "views.txt";
  EXPECT_THAT(of_the_sphere(c), ElementsAre("views.file is not read: views.layout must be file for that"));
}

TEST(SetupWarnings, CamerasThatAreTooNear) {
  Configuration c;
  c.views.radius = 0.25 + 0.19;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("49 of 49 views"), HasSubstr("sensor.min_range (200 mm)"),
                                                  HasSubstr("the nearest is 19"), HasSubstr("views.radius"))));
  c.views.radius = 0.25 + 0.21;
  EXPECT_THAT(of_the_sphere(c), IsEmpty());
}

TEST(SetupWarnings, CamerasThatAreTooFar) {
  Configuration c;
  c.planner.ray_length = 3.0;
  c.views.radius = 0.25 + 1.51;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("49 of 49 views"), HasSubstr("sensor.max_range (1.5 m)"),
                                                  HasSubstr("1.51 m"))));
  c.views.radius = 0.25 + 1.49;
  EXPECT_THAT(of_the_sphere(c), IsEmpty());
}

TEST(SetupWarnings, ScoringRaysThatEndBeforeTheObject) {
  Configuration c;
  c.planner.ray_length = 0.6;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("planner.ray_length is 600 mm"), HasSubstr("up to 65"))));
  c.planner.gain = "random";  // casts none
  EXPECT_THAT(of_the_sphere(c), IsEmpty());
}

TEST(SetupWarnings, VoxelsAsCoarseAsTheObject) {
  Configuration c;
  c.map.resolution = 0.2;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("voxels of 200 mm"), HasSubstr("500 mm long"),
                                                  HasSubstr("2.5 of them"), HasSubstr("map.resolution"))));
  c.map.resolution = 0.05;
  EXPECT_THAT(of_the_sphere(c), IsEmpty());
}

TEST(SetupWarnings, AFieldOfViewThatSeesASliver) {
  Configuration c;
  c.sensor.field_of_view = 3.0;
  EXPECT_THAT(of_the_sphere(c),
              ElementsAre(AllOf(HasSubstr("sensor.field_of_view (3 deg)"), HasSubstr("% of the object"))));
}

class SetupWarningFiles : public InTemporaryFolder {};

// One of three looks away; the start view is always turned to the object.
TEST_F(SetupWarningFiles, ViewsThatLookPastTheObject) {
  write_file(folder_ / "views.txt", "3\n0 0 -0.9 0 0 0 1\n0.1 0 -0.9 0 0 0 1\n0 0 0.9 0 0 0 1\n");
  Configuration c;
  c.views.layout = ViewLayout::file;
  c.views.file = (folder_ / "views.txt").string();
  EXPECT_THAT(of_the_sphere(c),
              ElementsAre(AllOf(HasSubstr("1 of 4 views"), HasSubstr("looks past"), HasSubstr("views.file"))));
}

TEST(SetupWarnings, AStartViewOfItsOwnIsWarnedOfByItsName) {
  Configuration c;
  c.planner.start_view = "0 0 0.05 0 0 0 1";
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("1 of 1 views (start view): inside the object"),
                                                  HasSubstr("change planner.start_view (0 0 0.05 0 0 0 1)"))));
  c.planner.start_view = "0 0 -0.9 0 0 0 1";
  EXPECT_THAT(of_the_sphere(c), IsEmpty());
  c.views.radius = 0.2;
  EXPECT_THAT(of_the_sphere(c), ElementsAre(AllOf(HasSubstr("48 of 48 views (candidates): inside"),
                                                  HasSubstr("change views.radius (200 mm)"))));
}

TEST(SetupWarnings, AreALineEach) {
  Configuration c;
  c.views.radius = 0.3;
  c.planner.ray_length = 0.01;
  c.sensor.field_of_view = 2.0;
  c.map.resolution = 0.4;
  const auto warnings = of_the_sphere(c);
  EXPECT_THAT(warnings, SizeIs(4));
  for (const std::string& warning : warnings) EXPECT_EQ(warning.find('\n'), std::string::npos) << warning;
}

}  // namespace
}  // namespace nextview
