// Little memory, few threads, long numbers and long loops: each run works, or ends with one clear line and 2, and what
// takes long can be stopped.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

class Limits : public ::testing::Test {
 protected:
  std::string out() const { return (folder_.path() / "out").string(); }
  static std::string box() { return NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply"; }
  std::string small_scan() const {
    return fmt::format(
        "scan {} --overwrite --out {} --views 2 --sensor.width 80 --sensor.height 60 --map.resolution 0.04 ", box(),
        out());
  }
  /// Of what the loader of shared libraries says before the program begins, the exit code is the loader's.
  static void expect_one_line(const Result& run, const std::string& what) {
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << what << "\n" << run.err;
    EXPECT_THAT(run.err, StartsWith("nextview: ")) << what;
    EXPECT_EQ(run.exit_code, 2) << what << "\n" << run.err;
  }
  fs::path write(const std::string& name, const std::string& content) {
    std::ofstream(folder_.path() / name, std::ios::binary) << content;
    return folder_.path() / name;
  }

  TemporaryFolder folder_;
};

TEST_F(Limits, PointsAndParametersBeyondAllBoundsEndAtOnce) {
  const std::string view = "view 0 0 0 0 0 0 1\n", point = "scan 0 0 0 0 0 0 1 1\n0 0 1\n";
  const auto refused = [&](const std::string& scene, const std::string& reason) {
    const fs::path file = write("scene.txt", scene);
    for (const char* semantics : {"published", "reference"}) {
      const Result run = nextview_behind("timeout --signal=KILL 20", "score --gain occlusion-aware --semantics " +
                                                                         (semantics + (" --scene " + file.string())));
      expect_one_line(run, scene + semantics);
      EXPECT_THAT(run.err, HasSubstr("scene.txt"));
      EXPECT_THAT(run.err, HasSubstr(reason));
    }
  };
  refused("scan 0 0 0 0 0 0 1 1\n1e39 0 0\n" + view, "scene.txt:2: the point lies beyond 1e+06 m");
  refused("scan 0 0 0 0 0 0 1 1\n0 -1e308 0\n" + view, "scene.txt:2: the point lies beyond 1e+06 m");
  refused("param max_ray_depth_m 1e30\n" + point + view, "max_ray_depth_m");
  refused("param max_sensor_range_m 1e30\n" + point + view, "max_sensor_range_m");
  refused("param occlusion_update_dist_m 1e30\n" + point + view, "occlusion_update_dist_m");
  refused("param img_width_px 1e300\n" + point + view, "img_width_px");
  refused(
      "param img_width_px 20000\nparam img_height_px 20000\nparam raycasting_resolution_x 10\n"
      "param raycasting_resolution_y 10\n" +
          point + view,
      "rays");
  refused("param raycasting_resolution_x 1e300\n" + point + view, "raycasting_resolution_x");
  refused("param resolution_m 4.9e-324\n" + point + view, "resolution_m");
}

TEST_F(Limits, SettingsBeyondAllBoundsSayWhatTheBoundsAre) {
  const std::vector<std::pair<std::string, std::string>> wrong = {{"sensor.width", "2147483648"},
                                                                  {"sensor.width", "2147483647"},
                                                                  {"views.count", "1000000000"},
                                                                  {"evaluation.surface_samples", "2000000000"},
                                                                  {"map.resolution", "1e-9"},
                                                                  {"map.region_edge", "1e9"},
                                                                  {"gibbs.chains", "1000000"},
                                                                  {"planner.ray_columns", "1000000"},
                                                                  {"map.resolution", "4.9e-324"},
                                                                  {"map.resolution", "1e308"},
                                                                  {"map.resolution", "-0.0"},
                                                                  {"sensor.max_range", "inf"},
                                                                  {"views.radius", "nan"},
                                                                  {"planner.ray_length", "1e308"},
                                                                  {"cloud.down_sampling_leaf", "-0.0"},
                                                                  {"evaluation.d_reg", "4.9e-324"},
                                                                  {"gibbs.sigma", "inf"},
                                                                  {"planner.gain_weight", "1e308"},
                                                                  {"object.longest_side", "4.9e-324"}};
  for (const auto& [key, value] : wrong) {
    const Result run =
        nextview_behind("timeout --signal=KILL 20", small_scan() + fmt::format("--no-pictures --{} {}", key, value));
    expect_one_line(run, key + " " + value);
    EXPECT_THAT(run.err, HasSubstr(key.substr(key.find('.') + 1)));
  }
}

// 14 s of one step on two cores: wherever in it the stop comes, it ends soon.
TEST_F(Limits, AStepOfMillionsOfPixelsCanBeStopped) {
  for (const double seconds : {0.5, 2.0, 4.0}) {
    const Result run = nextview_behind(
        fmt::format("timeout --preserve-status --signal=INT --kill-after=8 {}", seconds),
        fmt::format(
            "scan sphere --overwrite --out {} --no-pictures --no-surfaces --sensor.width 3000 --sensor.height 3000",
            out()));
    EXPECT_EQ(run.exit_code, 130) << "stopped after " << seconds << " s\n" << run.err;
  }
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

TEST_F(Limits, OfMemoryAndThreads) { GTEST_SKIP() << "a program with sanitizers takes terabytes of addresses"; }

#else

/// A shell's `ulimit` in front of the program.
std::string limited(const std::string& ulimit) { return fmt::format(R"(sh -c 'ulimit {}; exec "$0" "$@"')", ulimit); }

TEST_F(Limits, AMapThatDoesNotFitIsRefusedWithItsSize) {
  const std::string scan = "scan " + box() + " --no-pictures --map.resolution 0.0025 --overwrite --out " + out();
  const Result run = nextview_behind(limited("-v 1500000"), scan);
  expect_one_line(run, "map");
  EXPECT_THAT(run.err, HasSubstr("a map of 512 x 512 x 512 voxels needs"));
  EXPECT_THAT(run.err, HasSubstr("GB are available: use coarser voxels (--map.resolution)"));
}

TEST_F(Limits, ImagesThatDoNotFitAreRefusedWithTheirSize) {
  const std::string scan =
      "scan " + box() + " --no-pictures --sensor.width 9000 --sensor.height 9000 --overwrite --out " + out();
  const Result run = nextview_behind(limited("-v 3000000"), scan);
  expect_one_line(run, "images");
  EXPECT_THAT(run.err, HasSubstr("20 images of 9000 x 9000 pixels needs"));
  EXPECT_THAT(run.err, HasSubstr("--sensor.width"));
}

TEST_F(Limits, WithLittleMemoryItWorksOrSaysSoInOneLine) {
  int worked = 0, refused = 0, first = 500'000;
  for (const char* pictures : {"", "--no-pictures"}) {
    for (int kilobytes = first; kilobytes <= 2'000'000; kilobytes += 250'000) {
      const std::string limit = fmt::format("-v {}", kilobytes);
      const Result run = nextview_behind(limited(limit), small_scan() + pictures);
      if (run.exit_code == 127) continue;  // the loader of libraries could not even begin
      if (run.exit_code == 0) {
        ++worked;
        EXPECT_EQ(run.err, "");
        continue;
      }
      ++refused;
      expect_one_line(run, limit + " " + pictures);
      EXPECT_THAT(run.err, AnyOf(HasSubstr("memory"), HasSubstr("available"), HasSubstr("thread")));
    }
    first += 125'000;
  }
  EXPECT_GT(worked, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(Limits, WithFewThreadsItWorksOrSaysSoInOneLine) {
  // Root has no such limit.
  const std::string user = ::geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  fs::permissions(folder_.path(), fs::perms::all);
  int worked = 0, refused = 0;
  for (const char* pictures : {"", "--no-pictures"})
    for (const int threads : *pictures == '\0' ? std::array{1, 3, 8} : std::array{2, 5, 60}) {
      const Result run = nextview_behind(fmt::format("{}prlimit --nproc={}", user, threads), small_scan() + pictures);
      worked += run.exit_code == 0;
      refused += run.exit_code != 0;
      if (run.exit_code == 0)
        EXPECT_EQ(run.err, "") << threads;
      else
        expect_one_line(run, fmt::format("{} threads", threads));
    }
  EXPECT_GT(worked, 0);
  EXPECT_GT(refused, 0);
}

#endif

}  // namespace
}  // namespace nextview
