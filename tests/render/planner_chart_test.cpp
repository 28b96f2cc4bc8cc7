#include "ui/charts/planner_chart.hpp"

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

}  // namespace
}  // namespace nextview
