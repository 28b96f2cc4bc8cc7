// Coverage against views: planners beside random views and the greedy oracle, which knows the mesh. Prints a row for
// each object and policy as CSV, and their means; the README's table comes from it.
//   build/release/planner_comparison                                       the objects of the table, half an hour
//   build/release/planner_comparison --object part.stl --policy paper      some of it
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>

#include "core/session/session.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> objects;
  std::vector<std::string> policies = {"default", "paper", "proximity-count", "average-entropy", "area-factor"};
  int views = 12, width = 320, random_seeds = 5;
  double noise = 0.001, resolution = 0.01, cost_weight = -1.0;
};

/// Coverage of the visible surface and metres after each view.
struct Course {
  std::vector<double> coverage, path;

  explicit Course(int views) : coverage(static_cast<std::size_t>(views)), path(coverage.size()) {}
  void add(const Course& other, double weight) {
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      coverage[i] += weight * other.coverage[i];
      path[i] += weight * other.path[i];
    }
  }
  double mean() const {
    double sum = 0.0;
    for (const double c : coverage) sum += c;
    return sum / double(coverage.size());
  }
};

/// Parts that come with Debian and with the program. None was learned from.
std::vector<std::string> all_objects() {
  std::vector<std::string> objects = {"gearbox", "bunny", "slotted_housing", "slotted_plate"};
  for (const char* part : {"bearing", "head", "motor", "propeller", "sh1", "sh2", "shape", "video_part"})
    if (const fs::path file = fmt::format("/usr/share/opencascade/data/stl/{}.stl", part); fs::exists(file))
      objects.push_back(file.string());
  return objects;
}

Configuration configuration(const Options& options, const std::string& object, const std::string& policy) {
  Configuration c;
  if (policy == "paper") {
    const fs::path file = assets_folder() / "configurations" / "paper.toml";
    c = read_configuration(file, c);
  } else if (policy != "default") {
    c.planner.gain = policy;
  }
  c.object.file = object;
  c.sensor.height = c.sensor.height * options.width / c.sensor.width;
  c.sensor.width = options.width;
  c.sensor.range_noise = options.noise;
  c.map.resolution = options.resolution;
  if (options.cost_weight >= 0.0 && policy != "paper") c.planner.weights.cost = options.cost_weight;
  c.termination = {};
  c.termination.views = options.views;
  c.termination.surface_left = 0.0;
  return c;
}

Course scan(const Configuration& c) {
  Session session(c);
  while (session.finished().empty()) session.step();
  Course course(c.termination.views);
  double path = 0.0;
  for (std::size_t i = 0; i < course.coverage.size(); ++i) {
    const StepRecord& record = session.records().at(std::min(i, session.records().size() - 1));
    path += i < session.records().size() ? record.motion.distance : 0.0;
    course.coverage[i] = record.coverage_visible;
    course.path[i] = path;
  }
  return course;
}

Course course_of(const Options& options, const std::string& object, const std::string& policy) {
  Configuration c = configuration(options, object, policy);
  if (policy != "random") return scan(c);
  Course mean(options.views);
  for (int seed = 1; seed <= options.random_seeds; ++seed) {
    c.seed = static_cast<std::uint64_t>(seed);
    mean.add(scan(c), 1.0 / options.random_seeds);
  }
  return mean;
}

void print(const std::string& object, const std::string& policy, const Course& course, double gap_closed) {
  fmt::print("{},{},{:.2f},{:.3f},{:.2f}", object, policy, 100.0 * course.mean(), gap_closed, course.path.back());
  for (const double coverage : course.coverage) fmt::print(",{:.2f}", 100.0 * coverage);
  fmt::print("\n");
  std::fflush(stdout);
}

void compare(const Options& options) {
  const auto objects = options.objects.empty() ? all_objects() : options.objects;
  std::vector<std::string> policies = {"random", "oracle"};
  policies.insert(policies.end(), options.policies.begin(), options.policies.end());
  fmt::print("object,policy,mean_coverage[%],gap_closed,path[m]");
  for (int view = 1; view <= options.views; ++view) fmt::print(",{}", view);
  fmt::print("\n");
  std::map<std::string, Course> means;
  const auto gap_closed = [](const Course& course, const Course& random, const Course& oracle) {
    return (course.mean() - random.mean()) / (oracle.mean() - random.mean());
  };
  for (const std::string& object : objects) {
    std::map<std::string, Course> courses;
    for (const std::string& policy : policies) {
      const Course& course = courses.insert_or_assign(policy, course_of(options, object, policy)).first->second;
      means.try_emplace(policy, options.views).first->second.add(course, 1.0 / double(objects.size()));
      const Course& random = courses.at("random");
      const double closed = courses.contains("oracle") ? gap_closed(course, random, courses.at("oracle")) : 0.0;
      print(fs::path(object).stem().string(), policy, course, closed);
    }
  }
  for (const std::string& policy : policies)
    print("mean", policy, means.at(policy), gap_closed(means.at(policy), means.at("random"), means.at("oracle")));
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::Options options;
  CLI::App app("Coverage against views of planners, random views and the greedy oracle");
  app.add_option("--object", options.objects, "objects as for scan, separated by commas")->delimiter(',');
  app.add_option("--policy", options.policies, "default, paper, or gains; random and oracle always")->delimiter(',');
  app.add_option("--views", options.views)->check(CLI::Range(1, 100));
  app.add_option("--width", options.width, "of the image [px]")->check(CLI::Range(16, 4096));
  app.add_option("--noise", options.noise, "[m]");
  app.add_option("--resolution", options.resolution, "[m]");
  app.add_option("--cost-weight", options.cost_weight, "of Eq. 13, but for the paper's plan");
  app.add_option("--random-seeds", options.random_seeds)->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  nextview::compare(options);
  return 0;
}
