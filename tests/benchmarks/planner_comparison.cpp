// Coverage against views: planners beside random views and the greedy oracle, which knows the mesh. Prints a row for
// each object and policy as CSV, and their means; the manual's table comes from it (planning). Beside them the least
// number of candidates that see 95 and 99 % of what any of them sees. A dash stands where there is nothing to compare
// with: no gap between random views and the oracle, or nothing that views after the first showed.
//   build/release/planner_comparison                                       the objects of the table, four minutes
//   build/release/planner_comparison --object part.stl --policy paper      some of it
//   build/release/planner_comparison --from FILE.csv --chart FILE.png      README's picture of what it printed
//   build/release/planner_comparison --config FILE --at 1,2,4,6,10         coverage of all samples, as FILE has it: the
//                                                                          manual's published table
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "core/planner/set_cover.hpp"
#include "core/session/session.hpp"
#include "core/setting/quantity.hpp"
#include "tests/benchmarks/known_part_plan.hpp"
#include "tests/benchmarks/scan_course.hpp"
#include "ui/charts/planner_chart.hpp"
#include "ui/render_target/headless.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> objects;
  std::vector<std::string> policies = {"set-cover",       "default",         "paper",      "surface-edge-density",
                                       "proximity-count", "average-entropy", "area-factor"};
  int views = 12, width = 320, random_seeds = 5;
  double size = 0.5;                        // longest side [m]
  double noise = 0.001, resolution = 0.01;  // [m], of objects of half a metre: both follow the size
  std::string config;
  std::vector<std::string> set;
  std::vector<int> at;
};

/// Parts that come with Debian and with the program. None was learned from.
std::vector<std::string> all_objects() {
  std::vector<std::string> objects = {"gearbox", "bunny", "slotted_housing", "slotted_plate"};
  for (const char* part : {"bearing", "head", "motor", "propeller", "sh1", "sh2", "shape", "video_part"})
    if (const fs::path file = fmt::format("/usr/share/opencascade/data/stl/{}.stl", part); fs::exists(file))
      objects.push_back(file.string());
  return objects;
}

/// As --set has it.
void set(const Options& options, Configuration& c) {
  for (const std::string& one : options.set) {
    const std::size_t equals = one.find('=');
    give(c, one.substr(0, equals), equals == std::string::npos ? "" : one.substr(equals + 1), "--set " + one);
  }
}

Configuration configuration(const Options& options, const std::string& object, const std::string& policy) {
  Configuration c;
  set(options, c);
  if (policy == "paper") {
    const fs::path file = assets_folder() / "configurations" / "paper.toml";
    c = read_configuration(file, c);
  } else if (policy != "default") {
    c.planner.gain = policy;
  }
  c.object.file = object;
  c.object.longest_side = options.size;  // all alike, so that means mean something
  c.sensor.height = c.sensor.height * options.width / c.sensor.width;
  c.sensor.width = options.width;
  give(c, "sensor.range_noise", fmt::format("{:.6g}", options.noise * options.size / 0.5), "--noise");
  give(c, "map.resolution", fmt::format("{:.6g}", options.resolution * options.size / 0.5), "--resolution");
  c.termination = {};
  c.termination.views = options.views;
  c.termination.surface_left = 0.0;
  return c;
}

/// "known-part:2": who knows the part, and would see a share of the surface two views later for each metre less.
constexpr std::string_view known_part = "known-part:";

ScanCourse course_of_known_part(const Options& options, const std::string& object, const std::string& policy) {
  double weight = 0.0;
  if (!read_quantity(policy.substr(known_part.size()), "", weight) || !(weight >= 0.0))
    throw std::runtime_error(fmt::format("--policy {}: the weight must be a number of at least 0", policy));
  Session session(configuration(options, object, "fixed-order"));
  return course_of_scan(session, known_part_plan(*session.known_object(), session.next_view(), options.views, weight));
}

ScanCourse course_of(const Options& options, const std::string& object, const std::string& policy) {
  if (policy.starts_with(known_part)) return course_of_known_part(options, object, policy);
  Configuration c = configuration(options, object, policy);
  if (policy != "random") return course_of_scan(c);
  ScanCourse mean(options.views);
  for (int seed = 1; seed <= options.random_seeds; ++seed) {
    c.seed = static_cast<std::uint64_t>(seed);
    mean.add(course_of_scan(c), 1.0 / options.random_seeds);
  }
  return mean;
}

/// How many candidates it takes to see 95 and 99 % of what any of them sees; "<=": that no fewer do is not proven.
struct LeastViews {
  std::string of_95, of_99;
};

std::string least_views(const KnownObject& object, double share) {
  std::vector<std::vector<Covered>> seen(object.sight().candidates.size());
  for (std::size_t v = 0; v < seen.size(); ++v)
    for (const std::uint32_t sample : object.sight().seen_from(v)) seen[v].push_back({sample, 1.0f});
  const auto all = double(std::ranges::count(object.visible(), 1));
  const SetCover cover = least_cover(seen, (1.0 - share) * all, CoverLimits::patient());
  return fmt::format("{}{}", cover.is_least ? "" : "<=", cover.views.size());
}

LeastViews least_views(const Configuration& c) {
  const Session session(c);
  return {least_views(*session.known_object(), 0.95), least_views(*session.known_object(), 0.99)};
}

/// Where a plan stands between random views (0) and the oracle (1), and its way to the same coverage over the oracle's.
struct Standing {
  double gap_closed, way_share;
};

std::string number_or_dash(double number) { return std::isfinite(number) ? fmt::format("{:.3f}", number) : "-"; }

void print(const std::string& object, const std::string& policy, const ScanCourse& course, const Standing& standing,
           const LeastViews& least) {
  fmt::print("{},{},{:.2f},{},{:.2f},{},{},{}", object, policy, 100.0 * course.mean_coverage(),
             number_or_dash(standing.gap_closed), course.path.back(), number_or_dash(standing.way_share), least.of_95,
             least.of_99);
  for (const double coverage : course.coverage) fmt::print(",{:.2f}", 100.0 * coverage);
  fmt::print("\n");
  std::fflush(stdout);
}

void compare(const Options& options) {
  const auto objects = options.objects.empty() ? all_objects() : options.objects;
  std::vector<std::string> policies = {"oracle", "random"};
  for (const std::string& policy : options.policies)  // each once, or its mean would count it twice
    if (std::ranges::find(policies, policy) == policies.end()) policies.push_back(policy);
  fmt::print("object,policy,mean_coverage[%],gap_closed,path[m],path_to_same/oracle,least_views_95,least_views_99");
  for (int view = 1; view <= options.views; ++view) fmt::print(",{}", view);
  fmt::print("\n");
  std::map<std::string, ScanCourse> means;
  std::map<std::string, EqualCoverage> ways;
  const auto gap_closed = [](const ScanCourse& course, const ScanCourse& random, const ScanCourse& oracle) {
    return (course.mean_coverage() - random.mean_coverage()) / (oracle.mean_coverage() - random.mean_coverage());
  };
  for (const std::string& object : objects) {
    std::map<std::string, ScanCourse> courses;
    const LeastViews least = least_views(configuration(options, object, "default"));
    for (const std::string& policy : policies) {
      const ScanCourse& course = courses.insert_or_assign(policy, course_of(options, object, policy)).first->second;
      means.try_emplace(policy, options.views).first->second.add(course, 1.0 / double(objects.size()));
    }
    for (const std::string& policy : policies) {
      const ScanCourse &course = courses.at(policy), &oracle = courses.at("oracle");
      const EqualCoverage equal = EqualCoverage::of(course, oracle);
      ways[policy].way += equal.way, ways[policy].oracles += equal.oracles;
      print(fs::path(object).stem().string(), policy, course,
            {gap_closed(course, courses.at("random"), oracle), equal.share()}, least);
    }
  }
  for (const std::string& policy : policies)
    print("mean", policy, means.at(policy),
          {gap_closed(means.at(policy), means.at("random"), means.at("oracle")), ways.at(policy).share()}, {});
}

/// The gains that were published, random views, and ours.
const std::vector<std::string> table_policies = {"occlusion-aware",   "unobserved-voxel", "rear-side-voxel",
                                                 "rear-side-entropy", "proximity-count",  "area-factor",
                                                 "average-entropy",   "random",           "new-surface"};

/// As a file has it, and `--object` and `--set` after it; what else there is of options is the file's.
Configuration configuration_of_file(const Options& options) {
  const fs::path named = assets_folder() / "configurations" / (options.config + ".toml");
  Configuration c;
  read_settings(fs::exists(named) ? named : fs::path(options.config), c);
  for (const std::string& object : options.objects) give(c, "object.file", object, "--object");
  set(options, c);
  c.termination = {};
  c.termination.views = *std::max_element(options.at.begin(), options.at.end());
  c.termination.surface_left = 0.0;
  return c;
}

/// Share of all samples that is covered after each view of --at; the mean over seeds of random views.
void print_row(const Options& options, Configuration c, const std::string& policy) {
  c.planner.gain = policy;
  c.validate();
  const int runs = policy == "random" ? options.random_seeds : 1;
  std::vector<double> coverage(options.at.size());
  for (int run = 0; run < runs; ++run, ++c.seed) {
    Session session(c);
    while (session.finished().empty()) session.step();
    for (std::size_t i = 0; i < options.at.size(); ++i) {
      const std::size_t view = std::min(std::size_t(options.at[i]), session.records().size());
      coverage[i] += session.records().at(view - 1).coverage / runs;
    }
  }
  fmt::print("{}", policy);
  for (const double share : coverage) fmt::print(",{:.3f}", share);
  fmt::print("\n");
  std::fflush(stdout);
}

void print_table(const Options& options) {
  const Configuration c = configuration_of_file(options);
  fmt::print("policy,{}\n", fmt::join(options.at, ","));
  for (const std::string& policy : options.policies)
    print_row(options, c, policy == "default" ? PlannerConfig().gain : policy);
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::Options options;
  CLI::App app("Coverage against views of planners, random views and the greedy oracle");
  app.add_option("--object", options.objects, "objects as for scan, separated by commas")->delimiter(',');
  CLI::Option* policies =
      app.add_option("--policy", options.policies,
                     "default, paper, gains, or known-part:WEIGHT of the way; random and oracle always")
          ->delimiter(',');
  CLI::Option* config = app.add_option("--config", options.config, "a table as this configuration has it");
  app.add_option("--set", options.set,
                 "key=value, over the configuration; what another option or a policy sets is that")
      ->allow_extra_args(false);
  app.add_option("--at", options.at, "columns of the table: after so many views")
      ->delimiter(',')
      ->needs(config)
      ->check(CLI::Range(1, 100));
  std::string from, chart;
  CLI::Option* picture = app.add_option("--chart", chart, "draws what --from has, a PNG file, and nothing else");
  picture->needs(app.add_option("--from", from, "a CSV file that this program printed"));
  app.add_option("--views", options.views)->check(CLI::Range(1, 100));
  app.add_option("--width", options.width, "of the image [px]")->check(CLI::Range(16, 4096));
  app.add_option("--size", options.size, "longest side of the objects [m]; all other lengths follow it")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--noise", options.noise, "[m], of objects of half a metre");
  app.add_option("--resolution", options.resolution, "[m], of objects of half a metre");
  app.add_option("--random-seeds", options.random_seeds)->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  if (!*policies && *config) options.policies = nextview::table_policies;
  if (options.at.empty()) options.at = {1, 2, 4, 6, 10};
  try {
    if (*picture) {
      nextview::ensure_headless(argc, argv);
      nextview::write_png(nextview::draw_planner_chart(nextview::read_planner_courses(from)), chart);
    } else if (*config) {
      nextview::print_table(options);
    } else {
      nextview::compare(options);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
