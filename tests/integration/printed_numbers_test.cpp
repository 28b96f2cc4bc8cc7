// What the terminal says, against the files of the same run.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/file/atomic_file.hpp"
#include "tests/integration/housing_scan.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string printing_scan = "scan " + housing() + "--views 3 " + coarse_housing + "--no-pictures --no-surfaces ";

/// The words of the lines that begin with a number.
std::vector<std::vector<std::string>> numbered_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    if (!row.empty() && std::all_of(row[0].begin(), row[0].end(), ::isdigit) && row.size() > 5) rows.push_back(row);
  }
  return rows;
}

/// To three digits, and to the unit from a hundred on: of small parts, too, something is left.
std::string short_text(double value) {
  return value < 100.0 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

/// The words behind a label at the beginning of a line.
std::vector<std::string> behind(const std::string& text, const std::string& label) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(label)) continue;
    std::istringstream words(line.substr(label.size()));
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    return row;
  }
  ADD_FAILURE() << "no line begins with: " << label;
  return {"", ""};
}

class PrintedNumbers : public ::testing::Test {
 protected:
  std::string run(const std::string& arguments, int exit_code = 0) const {
    const Result result = nextview(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
    return result.out;
  }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  Table table(const std::string& name) const { return read_table(read_file(folder_.path() / name)); }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read_file(folder_.path() / name)); }
  const TemporaryFolder folder_;
};

// step, view, gain, moved [m], hits, new [voxels], coverage [% visible], unmeasured entropy [Mbit], log loss [nats],
// seconds
TEST_F(PrintedNumbers, AScansRowsAreThoseOfItsSteps) {
  // By this gain the two coverages differ at every step, so that they cannot be mixed up.
  const std::string out = run(printing_scan + "--gain proximity-count --out " + in("out"));
  EXPECT_THAT(out, HasSubstr("% visible   entropy Mbit"));
  const auto rows = numbered_rows(out.substr(out.find("% visible")));
  const Table steps = table("out/steps.csv");
  ASSERT_GE(rows.size(), 3u) << out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto cell = [&](const std::string& column) { return std::stod(steps[i].at(column)); };
    const std::vector<std::string> expected = {steps[i].at("step"),
                                               i == 0 ? "start" : steps[i].at("view"),
                                               fmt::format("{:.5g}", cell("gain[voxels]")),
                                               short_text(cell("distance[m]")),
                                               steps[i].at("hits"),
                                               short_text(cell("new_surface[cm²]")),
                                               fmt::format("{:.1f}", 100.0 * cell("coverage_visible@5mm")),
                                               fmt::format("{:.3f}", cell("entropy[bits]") / 1e6),
                                               fmt::format("{:.3f}", cell("log_loss_near_surface[nats]"))};
    ASSERT_EQ(rows[i].size(), expected.size() + 1) << "and the seconds";
    EXPECT_EQ(std::vector(rows[i].begin(), rows[i].end() - 1), expected);
    EXPECT_NE(fmt::format("{:.1f}", 100.0 * cell("coverage_visible@5mm")),
              fmt::format("{:.1f}", 100.0 * cell("coverage@5mm")));
  }
  const auto last = [&](const std::string& column) { return 100.0 * std::stod(steps.back().at(column)); };
  EXPECT_THAT(out, HasSubstr(fmt::format("surface {:.1f} %", last("coverage@5mm"))));
  EXPECT_THAT(out, HasSubstr(fmt::format("at the paper's 0.5 mm {:.1f} %", last("coverage@0.5mm"))));
  EXPECT_THAT(out, HasSubstr("at d_reg = 5 mm"));
  EXPECT_THAT(out, HasSubstr("Finished: " + json("out/metrics.json")["finished"].get<std::string>()));
}

TEST_F(PrintedNumbers, ARefinementsTableIsThatOfItsMetrics) {
  run(printing_scan + "--out " + in("scan"));
  const std::string out =
      run("refine " + in("scan") + " --gibbs.sweeps 80 --no-pictures --no-surfaces --out " + in("refined"));
  const auto metrics = json("refined/metrics.json");
  const auto expect = [&](const std::string& label, const std::string& json_pointer, const char* format, double scale) {
    const auto words = behind(out, label);
    const nlohmann::json::json_pointer at(json_pointer);
    EXPECT_EQ(words[0], fmt::format(fmt::runtime(format), scale * metrics["conventional"][at].get<double>())) << label;
    EXPECT_EQ(words[1], fmt::format(fmt::runtime(format), scale * metrics["gibbs"][at].get<double>())) << label;
    EXPECT_NE(metrics["conventional"][at], metrics["gibbs"][at]) << label;
  };
  expect("log loss near the surface, touch", "/touch truth/visited band/log_loss_nats", "{:.3f}", 1);
  expect("log loss near the surface, centre", "/centre truth/visited band/log_loss_nats", "{:.3f}", 1);
  expect("log loss, all visited, touch", "/touch truth/visited/log_loss_nats", "{:.3f}", 1);
  expect("D_KL, all visited, touch", "/touch truth/visited/d_kl_nats", "{:.1f}", 1e-3);
  expect("surface recall", "/surface_recall_touch", "{:.1f}", 100);
  const auto& d = metrics["diagnostics"];
  EXPECT_THAT(out, HasSubstr(fmt::format("{} rays merged to {}, {} voxels informed", d["measured_rays"].get<int>(),
                                         d["merged_rays"].get<int>(), d["informed_voxels"].get<int>())));
  const auto informed = behind(out, "voxels measured, informed");
  EXPECT_EQ(informed[1], std::to_string(d["informed_voxels"].get<int>()));

  const Table scores = table("refined/scores.csv");
  const auto best = [&](const std::string& column) {
    std::size_t first = 0;
    for (std::size_t v = 1; v < scores.size(); ++v)
      if (std::stod(scores[v].at(column)) > std::stod(scores[first].at(column))) first = v;
    return first;
  };
  EXPECT_THAT(out, HasSubstr(fmt::format("{} on the conventional map, {} on the Gibbs map; the ranks of all {} "
                                         "correlate {:.2f}.",
                                         best("gain_before[nats]"), best("gain_after[nats]"), scores.size(),
                                         metrics["rank_correlation_of_candidates"].get<double>())));
}

// The best five by each gain, as the CSV has them; ties in the order of the views.
TEST_F(PrintedNumbers, ScoresAreRankedAsTheirNumbersSay) {
  write_file(in("wall.txt"), wall_scene(0.02) +
                                 "view 0.3 0.1 0 0 0 0 1\nview 0 0.2 0.2 0 0 0 1\n"
                                 "view -0.2 0 0.1 0 0 0 1\nview 0 0 0.3 0 0 0 1\nview 0.1 0.1 0 0 0 0 1\n");
  const Table scores = read_table(run("score --scene " + in("wall.txt") + " --csv -"));
  const std::string out = run("score --scene " + in("wall.txt"));
  for (const auto& [gain, unit] : std::map<std::string, std::string>{
           {"occlusion-aware", "[nats]"}, {"unobserved-voxel", "[nats]"}, {"new-surface", "[cm²]"}, {"combined", ""}}) {
    std::vector<std::size_t> order;
    for (std::size_t v = 0; v < scores.size(); ++v) order.push_back(v);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return std::stod(scores[a].at(gain)) > std::stod(scores[b].at(gain)); });
    const auto words = behind(out, unit.empty() ? gain : gain + " " + unit);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(words.at(2 * i), fmt::format("{}:", order[i])) << gain;
      EXPECT_EQ(words.at(2 * i + 1), fmt::format("{:.6g}", std::stod(scores[order[i]].at(gain)))) << gain;
    }
  }
}

TEST_F(PrintedNumbers, ACalibrationsTableIsThatOfItsScores) {
  const std::string out =
      run("calibrate sphere --held-out slotted_plate --views 3 --sensor.width 60 --sensor.height 45 "
          "--map.resolution 0.04 --evaluation.surface_samples 1000 --no-pictures --out " +
          in("fit"));
  const Table scores = table("fit/scores.csv");
  ASSERT_EQ(scores.size(), 6u);
  for (std::size_t e = 0; e < 2; ++e) {
    const auto words = behind(out, e == 0 ? "sphere (fitted)" : "slotted_plate");
    ASSERT_GE(words.size(), 10u);
    EXPECT_EQ(words[0], "3");
    for (std::size_t map = 0; map < 3; ++map) {
      const auto& row = scores[3 * e + map];
      EXPECT_EQ(words[1 + map], fmt::format("{:.4f}", std::stod(row.at("cross_entropy[nats]"))));
      EXPECT_EQ(words[4 + map], fmt::format("{:.3f}", std::stod(row.at("log_loss_touch_near_surface[nats]"))));
      const std::string open = row.at("rows_open");
      EXPECT_EQ(words[7 + map], open.empty() ? "-" : fmt::format("{:.0f}", 100.0 * std::stod(open)));
    }
  }
  const Table descent = table("fit/descent.csv");
  for (const auto& [label, row] : {std::pair("before ", descent.front()), {"after ", descent.back()}}) {
    const auto words = behind(out, label);
    if (label == std::string("after ")) {
      EXPECT_EQ(words[0], fmt::format("{:.4f}", std::stod(row.at("hit"))));
      EXPECT_EQ(words[1], fmt::format("{:.4f}", std::stod(row.at("miss"))));
      EXPECT_EQ(words[2], fmt::format("{:.4f}", std::stod(row.at("clamp_min"))));
      EXPECT_EQ(words[3], fmt::format("{:.4f}", std::stod(row.at("clamp_max"))));
    } else {
      EXPECT_EQ(words[0] + words[1] + words[2] + words[3], "0.70000.40000.12000.9700");
    }
  }
}

// Whoever waits for a script must see that it did not finish: 130, with what was sampled until then.
TEST_F(PrintedNumbers, AStoppedRefinementEndsWith130) {
  run(printing_scan + "--out " + in("scan"));
  const std::string endless =
      "refine " + in("scan") +
      " --no-pictures --no-surfaces --gibbs.until_stationary false --gibbs.sweeps 1000000 --out " + in("refined");
  for (double seconds = 4.0; seconds < 200.0 && !fs::exists(in("refined/metrics.json")); seconds *= 2.0) {
    const Result stopped = nextview_interrupted(seconds, endless);
    EXPECT_EQ(stopped.exit_code, 130) << stopped.out << stopped.err;
    if (fs::exists(in("refined/metrics.json"))) {  // otherwise it had not begun to sample: longer
      EXPECT_THAT(stopped.out, HasSubstr("stopped after"));
    }
  }
  EXPECT_TRUE(fs::exists(in("refined/metrics.json")));
}

// Sweeps that are asked for are made, whatever the scan's own configuration says.
TEST_F(PrintedNumbers, ARefinementMakesTheSweepsThatItWasTold) {
  run(printing_scan + "--gibbs.sweeps 30 --out " + in("scan"));
  for (const int sweeps : {12, 20}) {
    run(fmt::format("refine {} --no-pictures --no-surfaces --gibbs.until_stationary false --gibbs.sweeps {} --out {}",
                    in("scan"), sweeps, in("refined")));
    EXPECT_EQ(json("refined/metrics.json")["diagnostics"]["sweeps"], sweeps);
    EXPECT_EQ(table("refined/trace.csv").size(), std::size_t(2 * sweeps));
  }
}

}  // namespace
}  // namespace nextview
