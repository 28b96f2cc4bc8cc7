#include "core/study/study_summary.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <sstream>

#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

constexpr const char* study_text = R"(
[[planning]]
objects = ["sphere", "box", "slotted_plate"]
policies = ["random", "oracle", "farthest"]
seeds = [1, 2, 3, 4]
views = 3
[[maps]]
objects = ["box"]
maps = ["octomap", "gibbs"]
)";

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::filesystem::path& csv) {
  std::istringstream in(read_file(csv));
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells(1);
    for (const char c : line) c == ',' ? cells.push_back("") : cells.back().push_back(c);
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells.at(i);
    rows.push_back(row);
  }
  return rows;
}

/// A study whose results are made up.
class Summary : public testing::Test {
 protected:
  Summary() {
    std::mt19937 random(5);
    for (std::size_t i = 0; i < study_.size(); ++i) {
      RunResult result;
      const StudyRun run = study_.run(i);
      if (run.object == "box" && run.method == "farthest" && run.seed > 2) {
        result.failure = "it broke \"badly\"";
      } else {
        const double value = double(random() % 5000) / 100.0 + (run.method == "oracle" ? 40.0 : 0.0);
        result.add(main_measure(run.part), 0.0, value);
        for (int view = 1; view <= 3; ++view) result.add("coverage[%]", view, value * view);
      }
      results_.push_back(result);
    }
  }

  /// The folder with every n-th of the results, as shards do them.
  StudyFolder shard(std::size_t i, std::size_t n, bool backwards = false) const {
    StudyFolder folder =
        StudyFolder::begin(folder_ / ("shard" + std::to_string(i) + "of" + std::to_string(n)), study_, keys_, true);
    for (std::size_t k = 0; k < study_.size(); ++k) {
      const std::size_t run = backwards ? study_.size() - 1 - k : k;
      if (run % n == i) folder.keep(keys_.keys[run], study_.run(run), results_[run], {});
    }
    return folder;
  }
  std::vector<Row> summary() const {
    const StudyFolder all = shard(0, 1);
    summarise(study_, keys_.keys, {&all, 1}, {1, study_.size()}, all.path());
    return rows_of(all.path() / "summary.csv");
  }
  /// Of a method on an object, by the main measure.
  std::vector<double> values(const std::string& object, const std::string& method) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < study_.size(); ++i)
      if (const auto* v = results_[i].find(main_measure(study_.run(i).part), 0.0);
          v && study_.run(i).object == object && study_.run(i).method == method)
        values.push_back(v->value);
    return values;
  }

  TemporaryFolder folder_;
  Study study_ = read_study(folder_.write("study.toml", study_text));
  StudyKeys keys_ = keys_of(study_);
  std::vector<RunResult> results_;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / double(values.size());
}

double spread_of(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double v : values) squares += (v - mean_of(values)) * (v - mean_of(values));
  return std::sqrt(squares / double(values.size() - 1));
}

Row row_of(const std::vector<Row>& rows, const std::string& object, const std::string& method,
           const std::string& measure) {
  for (const Row& row : rows)
    if (row.at("object") == object && row.at("method") == method && row.at("measure") == measure) return row;
  ADD_FAILURE() << object << ", " << method << ": no " << measure;
  return {};
}

TEST_F(Summary, HasMeansSpreadsAndPairedComparisons) {
  const auto rows = summary();
  std::vector<double> oracle_means, random_means, far_means;
  for (const std::string object : {"sphere", "box", "slotted_plate"}) {
    const auto random = values(object, "random"), oracle = values(object, "oracle");
    Row row = row_of(rows, object, "oracle", "mean_coverage[%]");
    EXPECT_NEAR(std::stod(row["mean"]), mean_of(oracle), 1e-4);
    EXPECT_NEAR(std::stod(row["spread"]), spread_of(oracle), 1e-4);
    EXPECT_EQ(row["runs"], "4");
    std::vector<double> differences;
    int better = 0;
    for (std::size_t i = 0; i < oracle.size(); ++i) {
      differences.push_back(oracle[i] - random[i]);
      better += oracle[i] > random[i];
    }
    row = row_of(rows, object, "oracle", "mean_coverage[%] - random");
    EXPECT_NEAR(std::stod(row["mean"]), mean_of(differences), 1e-3);
    EXPECT_NEAR(std::stod(row["spread"]), spread_of(differences), 1e-3);
    EXPECT_EQ(row["better"], std::to_string(better));
    oracle_means.push_back(mean_of(oracle));
    random_means.push_back(mean_of(random));
    far_means.push_back(mean_of(values(object, "farthest")));
  }
  Row row = row_of(rows, "(mean)", "oracle", "mean_coverage[%]");
  EXPECT_NEAR(std::stod(row["mean"]), mean_of(oracle_means), 1e-4);
  EXPECT_NEAR(std::stod(row["spread"]), spread_of(oracle_means), 1e-3);
  EXPECT_EQ(row["runs"], "3");
  row = row_of(rows, "(mean)", "farthest", "gap_closed");  // means over objects first
  const double gap = mean_of(oracle_means) - mean_of(random_means);
  EXPECT_NEAR(std::stod(row["mean"]), (mean_of(far_means) - mean_of(random_means)) / gap, 1e-4);
}

TEST_F(Summary, LessIsBetterOfAMap) {
  const double octomap = values("box", "octomap").at(0), gibbs = values("box", "gibbs").at(0);
  Row row = row_of(summary(), "box", "gibbs", "log_loss_near_surface[nats] - octomap");
  EXPECT_NEAR(std::stod(row["mean"]), gibbs - octomap, 1e-4);
  EXPECT_EQ(row["better"], gibbs < octomap ? "1" : "0");
}

TEST_F(Summary, BinsAndChainsAreToldOfTheMeanAlone) {
  for (std::size_t i = 0; i < study_.size(); ++i)
    if (results_[i].failure.empty()) results_[i].add("reliability_true", 0.05, double(i));
  const auto rows = summary();
  const auto count = [&](const std::string& object) {
    return std::ranges::count_if(
        rows, [&](const Row& row) { return row.at("object") == object && row.at("measure") == "reliability_true"; });
  };
  EXPECT_EQ(count("box"), 0);
  EXPECT_EQ(count("(mean)"), 5);  // a method of either part
  double octomap = 0.0;
  for (std::size_t i = 0; i < study_.size(); ++i)
    if (study_.run(i).method == "octomap") octomap = double(i);
  EXPECT_EQ(std::stod(row_of(rows, "(mean)", "octomap", "reliability_true")["mean"]), octomap);
}

TEST_F(Summary, ARunThatCameToNothingIsSaid) {
  const StudyFolder all = shard(0, 1);
  EXPECT_EQ(summarise(study_, keys_.keys, {&all, 1}, {1, study_.size()}, all.path()).failed, 2u);
  const std::string csv = read_file(all.path() / "summary.csv");
  EXPECT_THAT(csv, testing::HasSubstr("planning,1,box,default,3,farthest,failure,0,2,,,,"));
  EXPECT_THAT(csv, testing::HasSubstr("\"it broke \"\"badly\"\"\""));
}

TEST_F(Summary, IsTheSameHoweverItWasSharded) {
  const StudyFolder all = shard(0, 1);
  summarise(study_, keys_.keys, {&all, 1}, {1, study_.size()}, all.path());
  const std::string csv = read_file(all.path() / "summary.csv"), json = read_file(all.path() / "summary.json");
  std::vector<StudyFolder> shards;
  for (const std::size_t i : {2u, 0u, 1u}) shards.push_back(shard(i, 3, i == 1));
  const auto merged = StudyFolder::begin_merged(folder_ / "merged", shards[0]);
  summarise(study_, keys_.keys, shards, {1, study_.size()}, merged.path());
  EXPECT_EQ(read_file(merged.path() / "summary.csv"), csv);
  EXPECT_EQ(read_file(merged.path() / "summary.json"), json);
  shards.pop_back();
  EXPECT_THROW(summarise(study_, keys_.keys, shards, {1, study_.size()}, merged.path()), std::runtime_error);
}

TEST_F(Summary, OfSomeRunsHasTheirRows) {
  const Row whole = row_of(summary(), "box", "random", "mean_coverage[%]");
  const StudyFolder all = shard(0, 1);
  EXPECT_EQ(whole.at("of_runs"), "13-16");
  summarise(study_, keys_.keys, {&all, 1}, {13, 16}, all.path());
  EXPECT_EQ(row_of(rows_of(all.path() / "summary.csv"), "box", "random", "mean_coverage[%]"), whole);
}

/// Between random views and the oracle there is a gap only where both were run.
TEST(SummaryOfFewMethods, SaysNothingOfAGapThatIsNotThere) {
  for (const std::string methods : {"'random', 'farthest'", "'oracle', 'farthest'"}) {
    const TemporaryFolder folder;
    const Study study = read_study(folder.write(
        "study.toml", "[[planning]]\nobjects = ['sphere', 'box']\npolicies = [" + methods + "]\nviews = 2\n"));
    const StudyKeys keys = keys_of(study);
    const StudyFolder all = [&] {
      StudyFolder made = StudyFolder::begin(folder / "all", study, keys, true);
      for (std::size_t k = 0; k < study.size(); ++k) {
        RunResult result;
        result.add(main_measure(StudyPart::planning), 0.0, 10.0 + double(k));
        made.keep(keys.keys[k], study.run(k), result, {});
      }
      return made;
    }();
    summarise(study, keys.keys, {&all, 1}, {1, study.size()}, all.path());
    const auto rows = rows_of(all.path() / "summary.csv");
    EXPECT_GE(rows.size(), 4u);
    for (const Row& row : rows) EXPECT_NE(row.at("measure"), "gap_closed") << methods;
  }
}

}  // namespace
}  // namespace nextview
