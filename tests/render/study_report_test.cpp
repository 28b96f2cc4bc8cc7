// The HTML report of a study.
#include "ui/report/study_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A small study whose numbers are made up, and whose names are not HTML.
class StudyReport : public testing::Test {
 protected:
  StudyReport() {
    folder_.write("study.toml",
                  "name = \"a <b> & c\"\n[[planning]]\nobjects = [\"sphere\", \"box\"]\npolicies = [\"random\", "
                  "\"farthest\", \"oracle\"]\nseeds = [3, 5]\nviews = 2\n");
    folder_.write(
        "study.json",
        R"({"program": "nextview 9.9", "study": "a", "runs": 12, "objects": {"box": "7 bytes, crc32 0abc"}})");
    folder_.write("summary.csv",
                  "part,block,object,sensor,views,method,measure,at,runs,mean,spread,better,of_runs,hash,note\n"
                  "planning,1,box,default,2,random,mean_coverage[%],0,2,40.25,1.5,,7-8,00aa,\n"
                  "planning,1,box,default,2,farthest,failure,0,2,,,,9-10,00bb,<script>alert(1)</script>\n"
                  "planning,1,(mean),default,2,random,mean_coverage[%],0,2,41.04,2.5,,1-8,00cc,\n"
                  "planning,1,(mean),default,2,farthest,mean_coverage[%],0,2,45.55,3.5,,3-10,00dd,\n"
                  "planning,1,(mean),default,2,farthest,mean_coverage[%] - random,0,2,4.51,1.25,2,3-10,00dd,\n"
                  "planning,1,(mean),default,2,farthest,path[m],1,2,0.5,0,,3-10,00dd,\n"
                  "planning,1,(mean),default,2,farthest,path[m],2,2,1.75,0,,3-10,00dd,\n"
                  "planning,1,(mean),default,2,oracle,mean_coverage[%],0,2,60.04,3.5,,5-12,00ee,\n");
  }
  std::string report() const { return study_report(folder_ / "", SummaryTable(folder_ / "")); }
  TemporaryFolder folder_;
};

TEST_F(StudyReport, HasEachNumberWithItsRunsAndHash) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<td>farthest</td><td class=\"number\">2</td><td class=\"number\">45.5 ± 3.5</td>"
                              "<td class=\"number\">4.5 ± 1.2</td><td class=\"number\">2 of 2</td>"
                              "<td class=\"number\"></td><td class=\"number\"></td><td class=\"number\">1.75</td>"
                              "<td class=\"number\">3-10</td><td class=\"number\"><code>00dd</code></td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">40.2 ± 1.5</td>"));  // of the box alone
  EXPECT_THAT(html, HasSubstr("nextview study study.toml --runs FIRST-LAST --out again"));
  EXPECT_THAT(html, HasSubstr("seeds 3, 5"));
  EXPECT_THAT(html, HasSubstr("7 bytes, crc32 0abc"));
  EXPECT_THAT(html, HasSubstr("nextview 9.9, 12 runs"));
  EXPECT_THAT(html, Not(HasSubstr("difference to ,"))) << "of the box, where nothing is compared";
  EXPECT_EQ(html, report());
}

TEST_F(StudyReport, SaysWhatIsBestOfThoseThatDoNotKnowTheObject) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">4.5 ± 1.2 (random)</td>"));
  EXPECT_THAT(html, HasSubstr("<td>2</td><td>farthest</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<td>2</td><td>oracle</td>")));
}

/// What the others are compared with has no difference to itself, and needs no name beside it.
TEST_F(StudyReport, WhereTheBestIsWhatAllAreComparedWithNoDifferenceIsSaid) {
  std::string summary = read_file(folder_ / "summary.csv");
  const std::string mean = "random,mean_coverage[%],0,2,41.04";
  summary.replace(summary.find(mean), mean.size(), "random,mean_coverage[%],0,2,51.04");
  folder_.write("summary.csv", summary);
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<td>2</td><td>random</td><td class=\"number\">2</td><td class=\"number\">51.0 ± 2.5</td>"
                              "<td class=\"number\"></td><td class=\"number\"></td>"));
  EXPECT_THAT(html, Not(HasSubstr("(random)")));
}

TEST_F(StudyReport, NeedsNothingElseAndRunsNothing) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<h1>Study a &lt;b&gt; &amp; c</h1>"));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  for (const char* other : {"<script", "<link", "<img", "src=", "href=", "url(", "@import"})
    EXPECT_THAT(html, Not(HasSubstr(other)));
}

TEST_F(StudyReport, SaysWhichFileIsMissing) {
  std::filesystem::remove(folder_ / "study.json");
  EXPECT_THROW(
      try { report(); } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("study.json"));
        throw;
      },
      std::runtime_error);
}

TEST(OwnStudyReport, HasAllItsChartsAndNumbers) {
  const auto folder = std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets" / "studies" / "nextview";
  const std::string html = study_report(folder, SummaryTable(folder));
  std::size_t charts = 0;
  for (std::size_t at = 0; (at = html.find("<svg ", at)) != std::string::npos; ++at) ++charts;
  EXPECT_EQ(charts, 14u);
  // As the summary has them: (mean) of new-surface, its difference to random views, its gap closed.
  EXPECT_THAT(html, HasSubstr("<td>new-surface</td><td class=\"number\">8</td><td class=\"number\">89.1 ± 5.4</td>"
                              "<td class=\"number\">6.8 ± 5.4</td><td class=\"number\">8 of 8</td>"
                              "<td class=\"number\">0.92</td>"));
}

}  // namespace
}  // namespace nextview
