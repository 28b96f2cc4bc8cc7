// A study's summary and timings, as they are read again.
#include "core/study/summary_table.hpp"

#include <gmock/gmock.h>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* header =
    "part,block,object,sensor,views,method,measure,at,runs,mean,spread,better,of_runs,hash,note\n";

/// Every cell of a row is another, so that none is taken for its neighbour.
constexpr const char* rows =
    "planning,1,box,paper,12,random,mean_coverage[%],0,4,81.5,2.25,,13-16,00aa,\n"
    "planning,1,box,paper,12,random,coverage[%],1,4,40,1,,13-16,00aa,\n"
    "planning,1,box,paper,12,random,coverage[%],2,4,60,3,,13-16,00aa,\n"
    "planning,1,box,paper,12,oracle,mean_coverage[%],0,4,90.125,0.5,,17-20,00bb,\n"
    "planning,1,box,paper,12,oracle,mean_coverage[%] - random,0,4,8.625,0.75,3,17-20,00bb,\n"
    "planning,1,(mean),paper,12,random,mean_coverage[%],0,2,80,5,,1-16,00cc,\n"
    "planning,2,sphere,noisy,6,random,mean_coverage[%],0,1,70,0,,21-21,00dd,\n"
    "planning,2,box,noisy,6,random,mean_coverage[%],0,1,71,0,,22-22,00de,\n"
    "planning,2,sphere,noisy,6,oracle,mean_coverage[%],0,1,95,0,,23-23,00df,\n"
    "planning,2,\"a \"\"part\"\", odd\",noisy,6,mine,failure,0,2,,,,24-25,00ee,\"it broke, twice\"\n"
    "maps,3,box,wide,4,gibbs,log_loss_near_surface[nats],0,1,0.125,0,,26-26,00ff,\n";

class SummaryTables : public testing::Test {
 protected:
  SummaryTable read(const std::string& text) const {
    folder_.write("summary.csv", text);
    return SummaryTable(folder_.path());
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

const StudySetting first{StudyPart::planning, 1, "paper", 12}, second{StudyPart::planning, 2, "noisy", 6};

TEST_F(SummaryTables, EachCellIsWhatItsColumnSays) {
  const SummaryTable table = read(std::string(header) + rows);
  ASSERT_EQ(table.rows().size(), 11u);
  const SummaryRow& compared = table.rows()[4];
  EXPECT_EQ(compared.part, "planning");
  EXPECT_EQ(compared.block, 1u);
  EXPECT_EQ(compared.object, "box");
  EXPECT_EQ(compared.sensor, "paper");
  EXPECT_EQ(compared.views, 12);
  EXPECT_EQ(compared.method, "oracle");
  EXPECT_EQ(compared.measure, "mean_coverage[%] - random");
  EXPECT_EQ(compared.at, 0.0);
  EXPECT_EQ(compared.runs, 4u);
  EXPECT_EQ(compared.mean, 8.625);
  EXPECT_EQ(compared.spread, 0.75);
  EXPECT_EQ(compared.better, 3u);
  EXPECT_EQ(compared.first_run, 17u);
  EXPECT_EQ(compared.last_run, 20u);
  EXPECT_EQ(compared.hash, "00bb");
  EXPECT_EQ(compared.note, "");
  EXPECT_EQ(table.rows()[2].at, 2.0);
  EXPECT_FALSE(table.rows()[2].better) << "it is compared with nothing";
  const SummaryRow& failed = table.rows()[9];
  EXPECT_EQ(failed.object, "a \"part\", odd");
  EXPECT_EQ(failed.note, "it broke, twice");
  EXPECT_EQ(failed.mean, 0.0) << "it has none";
}

TEST_F(SummaryTables, AnswersWithWhatIsAskedForAlone) {
  const SummaryTable table = read(std::string(header) + rows);
  EXPECT_EQ(table.value(first, "box", "oracle", "mean_coverage[%]"), 90.125);
  EXPECT_EQ(table.value(first, "(mean)", "random", "mean_coverage[%]"), 80.0);
  const auto course = table.course(first, "box", "random", "coverage[%]");
  ASSERT_EQ(course.size(), 2u);
  EXPECT_EQ(course[0].at, 1.0);
  EXPECT_EQ(course[1].at, 2.0);
  EXPECT_EQ(course[1].mean, 60.0);
  EXPECT_EQ(course[1].spread, 3.0);
  // Each differs from a row that is there in one thing.
  EXPECT_FALSE(table.value({StudyPart::maps, 1, "paper", 12}, "box", "oracle", "mean_coverage[%]"));
  EXPECT_FALSE(table.value({StudyPart::planning, 2, "paper", 12}, "box", "oracle", "mean_coverage[%]"));
  EXPECT_FALSE(table.value({StudyPart::planning, 1, "noisy", 12}, "box", "oracle", "mean_coverage[%]"));
  EXPECT_FALSE(table.value({StudyPart::planning, 1, "paper", 6}, "box", "oracle", "mean_coverage[%]"));
  EXPECT_FALSE(table.value(first, "sphere", "oracle", "mean_coverage[%]"));
  EXPECT_FALSE(table.value(first, "box", "mine", "mean_coverage[%]"));
  EXPECT_FALSE(table.value(first, "box", "oracle", "path[m]"));
}

TEST_F(SummaryTables, NamesAreThereOnceInTheOrderOfTheFile) {
  const SummaryTable table = read(std::string(header) + rows);
  EXPECT_THAT(table.methods(first, "mean_coverage[%]"), ElementsAre("random", "oracle"));
  EXPECT_THAT(table.methods(first, "coverage[%]"), ElementsAre("random"));
  EXPECT_THAT(table.objects(first, "mean_coverage[%]"), ElementsAre("box")) << "the mean is no object";
  EXPECT_THAT(table.objects(second, "mean_coverage[%]"), ElementsAre("sphere", "box"));
  EXPECT_THAT(table.objects(first, "path[m]"), IsEmpty());
  EXPECT_THAT(table.settings(StudyPart::planning, "mean_coverage[%]"), ElementsAre(second, first))
      << "that with the most objects and methods first";
  EXPECT_THAT(table.settings(StudyPart::maps, "mean_coverage[%]"), IsEmpty());
}

TEST_F(SummaryTables, WhatIsNoRowIsNamedWithItsLine) {
  const std::string file = (folder_ / "summary.csv").string();
  EXPECT_EQ(error_of("run,key\n"), file + ": is no summary of a study");
  EXPECT_EQ(error_of(""), file + ": is no summary of a study");
  const std::string good = "maps,3,box,wide,4,gibbs,m,0,1,0.125,0,,26-26,00ff,\n";
  EXPECT_EQ(error_of(header + good), "no error");
  for (const char* bad : {"maps,3,box,wide,4,gibbs,m,0,1,0.125,0,,26-26,00ff\n",       // a cell too few
                          "maps,3,box,wide,4,gibbs,m,0,1,0.125,0,,26-26,00ff,,\n",     // one too many
                          "maps,three,box,wide,4,gibbs,m,0,1,0.125,0,,26-26,00ff,\n",  // a word for a number
                          "maps,3,box,wide,4.5,gibbs,m,0,1,0.125,0,,26-26,00ff,\n",    // half a view
                          "maps,3,box,wide,4,gibbs,m,0,1,0.125mm,0,,26-26,00ff,\n",    // more than a number
                          "maps,3,box,wide,4,gibbs,m,0,1,0.125,,,26-26,00ff,\n",       // a mean without a spread
                          "maps,3,box,wide,4,gibbs,m,0,1,0.125,0,,26-,00ff,\n"})       // no last run
    EXPECT_EQ(error_of(header + good + bad + good), file + ":3: is no row of a summary") << bad;
  EXPECT_THROW(SummaryTable(folder_ / "none"), std::runtime_error);
}

TEST_F(SummaryTables, SecondsComeBackAsTheyWereKept) {
  const Study study = read_study(folder_.write(
      "study.toml", "[[planning]]\nobjects = [\"parts/no, thing.ply\"]\npolicies = [\"random\"]\nviews = 3\n"));
  const StudyKeys keys = keys_of(study);
  EXPECT_TRUE(read_study_timings(folder_ / "out").empty()) << "there are none yet";
  const StudyFolder out = StudyFolder::begin(folder_ / "out", study, keys, false);
  RunSeconds seconds;
  seconds.stages = {.sense = 1.5, .clean = 2.5, .insert = 3.5, .refine = 4.5, .evaluate = 5.5, .score = 6.5};
  seconds.total = 30.25;
  out.keep(keys.keys[0], study.run(0), {}, seconds);
  std::ofstream(out.path() / study_timings_name, std::ios::app) << "0123,planning,box,pap";  // its program was killed
  const auto timings = read_study_timings(out.path());
  ASSERT_EQ(timings.size(), 1u);
  EXPECT_EQ(timings[0].part, "planning");
  EXPECT_EQ(timings[0].object, "no, thing");
  EXPECT_EQ(timings[0].sensor, "default");
  EXPECT_EQ(timings[0].views, 3);
  EXPECT_EQ(timings[0].method, "random");
  const StageSeconds& s = timings[0].seconds.stages;
  EXPECT_THAT((std::array{s.sense, s.clean, s.insert, s.refine, s.evaluate, s.score, timings[0].seconds.total}),
              ElementsAre(1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 30.25));
}

}  // namespace
}  // namespace nextview
