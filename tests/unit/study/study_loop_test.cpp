// Which runs of a study are done, in what order, and what is said meanwhile.
#include "core/study/study_loop.hpp"

#include <gmock/gmock.h>

#include "core/file/atomic_file.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/file/file_size_limit.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::MatchesRegex;

std::vector<std::size_t> taken(const StudyShare& share, std::size_t runs) {
  std::vector<std::size_t> numbers;
  for (std::size_t number = 1; number <= runs; ++number)
    if (share.takes(number)) numbers.push_back(number);
  return numbers;
}

TEST(StudyShare, TakesItsRangeWithBothEnds) {
  EXPECT_THAT(taken({{3, 5}}, 9), ElementsAre(3, 4, 5));
  EXPECT_THAT(taken({{4, 4}}, 9), ElementsAre(4));
  EXPECT_THAT(taken({{5, 4}}, 9), IsEmpty());
}

TEST(StudyShare, TakesEachNthFromItsOwnNumberOn) {
  EXPECT_THAT(taken({{1, 9}, 1, 3}, 9), ElementsAre(1, 4, 7));
  EXPECT_THAT(taken({{1, 9}, 3, 3}, 9), ElementsAre(3, 6, 9));
  EXPECT_THAT(taken({{2, 6}, 1, 3}, 9), ElementsAre(4)) << "of those within the range";
  EXPECT_THAT(taken({{2, 6}, 2, 2}, 9), ElementsAre(2, 4, 6));
}

/// Six runs of an object that is not there: each is a result, and takes no time.
class StudyLoop : public testing::Test {
 protected:
  StudyFolder begin(bool resume = false) const { return StudyFolder::begin(folder_ / "out", study_, keys_, resume); }
  /// The numbers of the runs that are done.
  std::vector<std::size_t> run(const StudyFolder& out, const StudyShare& share, const Progress& progress = {},
                               const std::stop_token& stop = {}) const {
    std::vector<std::size_t> numbers;
    const RunDone done = [&](std::size_t number, const StudyRun& run, const RunResult& result, const RunSeconds&) {
      numbers.push_back(number);
      EXPECT_EQ(run.text(), study_.run(number - 1).text());
      EXPECT_THAT(result.failure, testing::HasSubstr("nowhere.ply"));
      EXPECT_TRUE(out.has(keys_.keys[number - 1])) << "it is kept before it is told of";
    };
    run_study(study_, keys_, out, share, false, done, progress, stop);
    return numbers;
  }

  TemporaryFolder folder_;
  Study study_ = read_study(folder_.write("study.toml",
                                          "[[planning]]\nobjects = [\"nowhere.ply\"]\nviews = 3\n"
                                          "policies = [\"random\"]\nseeds = [1, 2, 3, 4, 5, 6]\n"));
  StudyKeys keys_ = keys_of(study_);
};

TEST_F(StudyLoop, DoesItsShareAndWhatIsLeftWhenItGoesOn) {
  {
    const StudyFolder out = begin();
    EXPECT_THAT(run(out, {{1, 6}, 2, 2}), ElementsAre(2, 4, 6));
    EXPECT_FALSE(out.has(keys_.keys[0]));
    EXPECT_THAT(run(out, {{1, 4}}), ElementsAre(1, 3));
  }
  const StudyFolder again = begin(true);
  EXPECT_THAT(run(again, {{1, 6}}), ElementsAre(5)) << "the others are there";
  EXPECT_THAT(run(again, {{1, 6}}), IsEmpty());
}

TEST_F(StudyLoop, NobodyNeedsToListen) {
  const StudyFolder out = begin();
  run_study(study_, keys_, out, {{1, 2}}, false, {}, {}, {});
  EXPECT_TRUE(out.has(keys_.keys[0]) && out.has(keys_.keys[1]));
  EXPECT_FALSE(out.has(keys_.keys[2]));
}

TEST_F(StudyLoop, SaysHowManyRunsAreDoneOfThoseThatItDoes) {
  std::vector<double> fractions;
  std::vector<std::string> words;
  run(begin(), {{2, 5}}, [&](double fraction, std::string_view what) {
    fractions.push_back(fraction);
    words.emplace_back(what);
  });
  EXPECT_THAT(fractions, ElementsAre(0.0, 0.25, 0.5, 0.75));
  EXPECT_THAT(words, ElementsAre("run 1 of 4: nowhere, default, 3 views, random, start 30 20, seed 2",
                                 MatchesRegex("run 2 of 4: .*, seed 3; about [0-9]+ s left"),
                                 MatchesRegex("run 3 of 4: .*, seed 4; about [0-9]+ s left"),
                                 MatchesRegex("run 4 of 4: .*, seed 5; about [0-9]+ s left")));
}

TEST_F(StudyLoop, OnAFullDiskNoPartOfARowIsLeft) {
  const StudyFolder out = begin();
  const std::filesystem::path file = folder_ / "out/timings.csv";
  const std::string before = timing_columns + std::string(10'000, 'x') + "\n";
  write_file(file, before);
  {
    const FileSizeLimit full(before.size() + 10);
    EXPECT_THAT([&] { out.keep(keys_.keys[0], study_.run(0), RunResult{}, RunSeconds{}); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::HasSubstr("timings.csv: cannot be written: File too large")));
  }
  EXPECT_EQ(read_file(file) == before, true);
  out.keep(keys_.keys[1], study_.run(1), RunResult{}, RunSeconds{});
  EXPECT_EQ(read_file(file).starts_with(before + keys_.keys[1] + ','), true);
}

TEST_F(StudyLoop, AStopLeavesWhatIsDone) {
  std::stop_source stop;
  int told = 0;
  const Progress progress = [&](double, std::string_view) {
    if (++told == 2) stop.request_stop();
  };
  const StudyFolder out = begin();
  EXPECT_THROW(run(out, {{1, 6}}, progress, stop.get_token()), Stopped);
  EXPECT_TRUE(out.has(keys_.keys[0]));
  EXPECT_FALSE(out.has(keys_.keys[2]));
  EXPECT_THAT(run(out, {{3, 6}}), ElementsAre(3, 4, 5, 6));
}

}  // namespace
}  // namespace nextview
