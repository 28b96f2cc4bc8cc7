#include "ui/charts/planner_chart.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tests/render/render_test.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

std::vector<PlannerCourse> read(const std::string& text) {
  const TemporaryFolder own;
  const auto file = own / "courses.csv";
  std::ofstream(file) << text;
  return read_planner_courses(file);
}

TEST(PlannerChart, ReadsTheViewsOfEachObjectAndPolicy) {
  const auto courses =
      read("object,policy,path[m],1,2\nbox,random,3.5,10,20.5\nbox,oracle,1,30,40\nmean,random,1,1,2\n");
  ASSERT_EQ(courses.size(), 2u);
  EXPECT_EQ(courses[0].object, "box");
  EXPECT_EQ(courses[0].policy, "random");
  EXPECT_EQ(courses[0].coverage, (std::vector<double>{10, 20.5}));
  EXPECT_EQ(courses[1].policy, "oracle");
}

TEST(PlannerChart, RefusesWhatIsNoTable) {
  for (const char* bad : {"", "step,view\n1,2\n", "object,policy,1,2\nbox,random,10\n",
                          "object,policy,1,2\nbox,random,10,much\n", "object,policy,1,2\nbox,random,10,101\n"})
    EXPECT_THROW(read(bad), std::runtime_error) << bad;
  EXPECT_THROW(draw_planner_chart({}), std::invalid_argument);
}

// What the README says of the default plan, drawn; the table's run takes half an hour (tests/data/README.md).
TEST(Figures, CoverageByPlanner) {
  expect_screenshot("coverage_by_planner",
                    draw_planner_chart(read_planner_courses(NEXTVIEW_SOURCE_DIR "/tests/data/planner_comparison.csv")));
}

TEST(PlannerChart, DrawsPoliciesThatItDoesNotKnowAndAnyNumberOfObjects) {
  EXPECT_EQ(draw_planner_chart({{"a", "mine", {10, 60}}, {"b", "mine", {20, 70}}}, 800, 600).width, 800);
}

TEST(PlannerChart, GivesPoliciesThatItDoesNotKnowColoursOfTheirOwn) {
  const auto shows = [](const Image& image, const Colour& colour) {
    const auto channel = [&](int c) { return static_cast<int>(std::lround(255.0 * colour[std::size_t(c)])); };
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      if (image.rgba[i] == channel(0) && image.rgba[i + 1] == channel(1) && image.rgba[i + 2] == channel(2))
        return true;
    return false;
  };
  const std::vector<PlannerCourse> courses{{"a", "default", {10, 60}}, {"a", "mine", {20, 70}}, {"a", "other", {5, 9}}};
  const Image both = draw_planner_chart(courses, 800, 600);
  for (const std::size_t series : {0u, 1u, 2u}) EXPECT_TRUE(shows(both, theme::series[series])) << series;
  EXPECT_FALSE(shows(both, theme::series[3]));
}

}  // namespace
}  // namespace nextview
