// `nextview score` against the numbers of the reference code.
#include "tests/data/conformance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

std::vector<std::vector<std::string>> rows(const std::string& csv) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    for (table.emplace_back(); std::getline(cells, line, ',');) table.back().push_back(line);
  }
  return table;
}

TEST(Conformance, ScoresEqualTheReferenceCodes) {
  const TemporaryFolder folder;
  for (const std::string set : conformance_sets) {
    const Result run = nextview("score --semantics reference --gain all --csv - --scene " +
                                unpack_conformance_scene(set, folder.path()).string());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto ours = rows(run.out), expected = rows(read_file(conformance_file(set + ".expected.csv")));
    ASSERT_EQ(ours.size(), 49u);
    ASSERT_EQ(expected.size(), 49u);
    for (std::size_t view = 1; view < expected.size(); ++view)
      for (std::size_t gain = 1; gain <= 7; ++gain) {
        const double value = std::stod(ours[view][gain]), reference = std::stod(expected[view][gain]);
        EXPECT_NEAR(value, reference, 1e-3 * std::abs(reference) + 1e-13)
            << set << ", view " << view - 1 << ", " << ours[0][gain];
      }
  }
}

}  // namespace
}  // namespace nextview
