// --config, once and several times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ConfigurationFiles : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    write_file(folder_.path() / name, content);
    return " --config " + (folder_.path() / name).string();
  }
  /// The configuration that a scan with these options has.
  std::string scanned(const std::string& options) const {
    const Result run = scan(options);
    EXPECT_EQ(run.exit_code, 0) << options << "\n" << run.err;
    return read_file(folder_.path() / "out" / "config.toml");
  }
  void expect_error(const std::string& options, const std::string& word) const {
    fs::remove_all(folder_.path() / "out");
    const Result run = scan(options);
    EXPECT_EQ(run.exit_code, 2) << options;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(folder_.path() / "out")) << options;
  }
  const TemporaryFolder folder_;

 private:
  Result scan(const std::string& options) const {
    return nextview(
        "scan box --views 1 --views.count 4 --no-pictures --no-surfaces --sensor.width 40 "
        "--sensor.height 30 --evaluation.surface_samples 100 --overwrite --out " +
        (folder_.path() / "out").string() + options);
  }
};

TEST_F(ConfigurationFiles, LaterOnesOverrideEarlierOnesAndOptionsOverrideBoth) {
  const std::string a = write("a.toml", "seed = 3\n[map]\nresolution = 0.04\nhit = 0.8\n");
  const std::string b = write("b.toml", "[map]\nresolution = 0.05\n[sensor]\nrange_noise = 0.004\n");
  const std::string ab = scanned(a + b), ba = scanned(b + a), all = scanned(" --map.resolution 0.06" + a + b);
  EXPECT_EQ(toml_value(ab, "resolution"), "0.05");
  EXPECT_EQ(toml_value(ba, "resolution"), "0.04");
  EXPECT_EQ(toml_value(all, "resolution"), "0.06") << "wherever the option stands";
  for (const std::string& found : {ab, ba, all}) {
    EXPECT_EQ(toml_value(found, "seed"), "3");
    EXPECT_EQ(toml_value(found, "hit"), "0.8");
    EXPECT_EQ(toml_value(found, "range_noise"), "0.004");
  }
}

TEST_F(ConfigurationFiles, TheSameOneTwiceOrAnEmptyOneChangesNothing) {
  const std::string a = write("a.toml", "seed = 3\n[map]\nresolution = 0.04\n");
  const std::string empty = write("empty.toml", "");
  const std::string once = scanned(a);
  EXPECT_EQ(scanned(a + a), once);
  EXPECT_EQ(scanned(a + empty), once);
  EXPECT_EQ(scanned(empty + a), once);
}

TEST_F(ConfigurationFiles, NamesThatComeWithTheProgramMixWithFiles) {
  const std::string coarse = write("coarse.toml", "[map]\nresolution = 0.04\n[gibbs]\nsweeps = 7\n");
  const std::string last = scanned(" --config paper" + coarse), first = scanned(coarse + " --config paper");
  EXPECT_EQ(toml_value(last, "sweeps"), "7");
  EXPECT_EQ(toml_value(first, "sweeps"), "20");
  EXPECT_EQ(toml_value(last, "resolution"), "0.04");
}

TEST_F(ConfigurationFiles, AFaultInAnyOfThemIsOneLineThatNamesIt) {
  const std::string a = write("a.toml", "[map]\nresolution = 0.04\n");
  const std::string unknown = write("unknown.toml", "seed = 4\n[map]\nresolutoin = 0.04\n");
  const std::string bad = write("bad.toml", "[map]\nresolution = -1\n");
  const std::string missing = " --config " + (folder_.path() / "missing.toml").string();
  expect_error(a + missing, "missing.toml");
  expect_error(missing + a, "missing.toml");
  expect_error(a + unknown, "unknown.toml:3");
  expect_error(unknown + a, "unknown.toml:3");
  expect_error(a + bad, "map.resolution");
  expect_error(a + " --config " + folder_.path().string(), folder_.path().string());
  expect_error(a + " --config", "--config");
}

}  // namespace
}  // namespace nextview
