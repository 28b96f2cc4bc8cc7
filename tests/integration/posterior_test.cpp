// The teaching command as a student runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;

constexpr const char* problems[] = {"corridor", "contradiction", "slot", "grid"};

struct Row {
  double exact = 0.0, sampler = 0.0, octomap = 0.0, reach = 0.0;
  bool informed = false;
};

std::vector<Row> read_rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "voxel,x,y,z,exact,sampler,informed,reach,octomap");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    int voxel = 0, x = 0, y = 0, z = 0, informed = 0;
    Row row;
    fields >> voxel >> x >> y >> z >> row.exact >> row.sampler >> informed >> row.reach >> row.octomap;
    EXPECT_TRUE(fields) << line;
    EXPECT_EQ(voxel, static_cast<int>(rows.size()));
    row.informed = informed == 1;
    rows.push_back(row);
  }
  return rows;
}

std::vector<Row> rows_of(const std::string& arguments) {
  const Result run = nextview("posterior --csv - " + arguments);
  EXPECT_EQ(run.exit_code, 0) << arguments << ": " << run.err;
  return read_rows(run.out);
}

TEST(Posterior, theSamplerIsWithinAHundredthOfTheExactPosterior) {
  for (const std::string problem : problems)
    for (const std::string model : {"attenuation", "beam"}) {
      SCOPED_TRACE(problem + ", " + model);
      const std::vector<Row> rows = rows_of("--problem " + problem + " --model " + model);
      EXPECT_GE(rows.size(), 10u);
      for (std::size_t voxel = 0; voxel < rows.size(); ++voxel) {
        const Row& row = rows[voxel];
        if (row.informed) {
          EXPECT_NEAR(row.sampler, row.exact, 0.01) << voxel;
        } else {
          EXPECT_EQ(row.sampler, 0.5) << voxel;
        }
      }
      EXPECT_GT(std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.informed; }), 5);
    }
}

/// Of which the sampler's numbers are not looked at: some sweeps do.
std::vector<Row> exact_rows_of(const std::string& arguments) { return rows_of(arguments + " --sweeps 100"); }

/// What the explanations say is what the numbers say.
TEST(Posterior, theProblemsShowWhereIndependenceGoesWrong) {
  const std::vector<Row> corridor = exact_rows_of("--problem corridor");
  EXPECT_GT(corridor[5].octomap, 0.5);
  EXPECT_GT(corridor[6].octomap, 0.5);
  EXPECT_GT(corridor[5].exact, 0.9);
  EXPECT_LT(corridor[6].exact, 0.2);
  EXPECT_LT(corridor[8].reach, 0.5);
  const std::vector<Row> filled = exact_rows_of("--problem contradiction");
  EXPECT_GT(std::min(filled[4].exact, filled[7].exact), 0.95);
  const std::vector<Row> beam = exact_rows_of("--problem contradiction --model beam");
  EXPECT_NEAR(beam[4].exact, 0.5, 0.2);
  EXPECT_NEAR(beam[7].exact, 0.5, 0.2);
  const std::vector<Row> slot = exact_rows_of("--problem slot");
  EXPECT_GT(slot[5].octomap, 0.8) << "the opening";
  EXPECT_LT(slot[5].exact, 0.05);
  for (const int wall : {4, 6, 7}) EXPECT_GT(slot[wall].exact, 0.95);
  const std::vector<Row> grid = exact_rows_of("--problem grid");
  EXPECT_NEAR(grid[7].octomap, 0.4, 1e-6);
  EXPECT_LT(grid[7].exact, 0.1);
}

TEST(Posterior, printsATableAndWhatToLookAt) {
  const TemporaryFolder folder;
  const std::string csv = (folder.path() / "slot.csv").string();
  const Result run = nextview("posterior --problem slot --sweeps 1000 --csv " + csv);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* word : {"slot: ", "exact", "sampler", "difference", "OctoMap", "hidden", "opening"})
    EXPECT_THAT(run.out, HasSubstr(word));
  EXPECT_THAT(run.out, HasSubstr("\n    5  1 1 0 "));
  EXPECT_EQ(read_rows(read_file(csv)).size(), 12u);
}

TEST(Posterior, theSeedAloneDecides) {
  const std::string command = "posterior --problem corridor --sweeps 500 --csv - --seed ";
  EXPECT_EQ(nextview("--threads 1 " + command + "7").out, nextview("--threads 2 " + command + "7").out);
  EXPECT_NE(nextview(command + "7").out, nextview(command + "8").out);
}

TEST(Posterior, itsFormerOptionIsReadAndSaid) {
  const Result now = nextview("posterior --problem corridor --sweeps 500 --csv -");
  const Result former = nextview("posterior --toy corridor --sweeps 500 --csv -");
  EXPECT_EQ(former.exit_code, 0);
  EXPECT_EQ(former.out, now.out);
  EXPECT_THAT(former.err, HasSubstr("--problem"));
  EXPECT_EQ(now.err, "");
}

TEST(Posterior, listsItsProblems) {
  const Result list = nextview("posterior --problem list"), help = nextview("posterior --help");
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(help.exit_code, 0);
  for (const char* problem : problems) {
    EXPECT_THAT(list.out, HasSubstr(problem));
    EXPECT_THAT(help.out, HasSubstr(problem));
  }
  EXPECT_THAT(help.out, HasSubstr("Example"));
}

TEST(Posterior, badInputIsOneLineAndExitCode2) {
  const auto expect_error = [](const std::string& arguments, const std::string& word) {
    const Result run = nextview("posterior " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr(word));
  };
  expect_error("", "--problem");
  expect_error("--problem teapot", "slot");
  expect_error("--problem slot --model telescope", "attenuation");
  for (const char* prior : {"0", "1", "nan", "-0.5", "much"})
    expect_error(std::string("--problem slot --prior ") + prior, "prior");
  for (const char* sigma : {"0", "nan", "inf"}) expect_error(std::string("--problem slot --sigma ") + sigma, "sigma");
  expect_error("--problem slot --sigma -0.001", "sigma");
  expect_error("--problem slot --sigma '1 ml'", "--sigma: takes a number [m]");
  const std::string quick = "posterior --problem corridor --sweeps 100 --sigma ";
  EXPECT_EQ(nextview(quick + "'1 mm'").out, nextview(quick + "0.001").out);
  for (const char* sweeps : {"0", "-5", "99999999999"})
    expect_error(std::string("--problem slot --sweeps ") + sweeps, "sweeps");
  expect_error("--problem slot --csv /no/such/folder/slot.csv", "/no/such/folder");
}

}  // namespace
}  // namespace nextview
