#include "tests/unit/config/configuration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/config/configuration_text.hpp"

namespace nextview {
namespace {

std::string default_toml() {
  const Configuration defaults;
  return to_toml(defaults);
}

TEST_F(ConfigurationFile, RoundTrip) {
  Configuration changed;
  changed.seed = 9223372036854775807u;
  changed.object.file = "a \"quoted\" näme\\with\tmore # than = usual.ply";
  changed.sensor.range_noise = 1.0 / 3.0 * 1e-7;
  changed.sensor.width = 123;
  changed.map.insertion = Insertion::local_octree;
  changed.map.resolution = 0.1 + 0.2;
  changed.planner.gain = "oracle";
  changed.planner.semantics = Semantics::reference;
  changed.views.layout = ViewLayout::fibonacci;
  changed.evaluation.enabled = false;
  changed.cloud.down_sampling = true;
  changed.termination.coverage = 1e-5;
  changed.planner.combined_weights = "average-entropy=2,rear-side-voxel=0.1";
  for (const Configuration& configuration : {Configuration(), changed}) {
    const Configuration again = read(to_toml(configuration));
    EXPECT_EQ(texts(again), texts(configuration));
    EXPECT_EQ(to_toml(again), to_toml(configuration));
  }
}

// Every setting, one at a time, through a file.
TEST_F(ConfigurationFile, EverySettingIsReadFromAFile) {
  Configuration names;
  for (const Setting& s : settings(names)) {
    if (s.key == "sensor.preset") continue;
    std::string value = "another";
    if (std::holds_alternative<bool*>(s.value)) value = s.text() == "true" ? "false" : "true";
    if (std::holds_alternative<int*>(s.value) || std::holds_alternative<std::uint64_t*>(s.value)) value = "7";
    if (std::holds_alternative<double*>(s.value)) value = "0.625";
    if (const auto* c = std::get_if<Setting::Choice>(&s.value)) value = c->names[(c->get() + 1) % c->names.size()];
    const bool is_text =
        std::holds_alternative<std::string*>(s.value) || std::holds_alternative<Setting::Choice>(s.value);
    const std::vector<std::string> found = texts(read(s.key + " = " + (is_text ? "'" + value + "'" : value) + "\n"));
    std::vector<std::string> expected = default_texts();
    std::replace(expected.begin(), expected.end(), s.key + " = " + s.text(), s.key + " = " + value);
    EXPECT_EQ(found, expected) << s.key;
    EXPECT_NE(found, default_texts()) << s.key;
  }
}

TEST_F(ConfigurationFile, WhatTheFileLeavesOutStays) {
  Configuration base;
  base.seed = 5;
  base.map.resolution = 0.03;
  const Configuration read_over = read("[map]\nregion_edge = 2\n", base);
  EXPECT_EQ(read_over.seed, 5u);
  EXPECT_EQ(read_over.map.resolution, 0.03);
  EXPECT_EQ(read_over.map.region_edge, 2.0);
  EXPECT_EQ(texts(read("", base)), texts(base));
}

TEST_F(ConfigurationFile, UnknownKeysNameTheLineAndTheNearest) {
  const std::string why = reason("# a scan\n[sensor]\nwidht = 3\n");
  EXPECT_NE(why.find(":3:"), std::string::npos) << why;
  EXPECT_NE(why.find("sensor.widht"), std::string::npos) << why;
  EXPECT_NE(why.find("'sensor.width'"), std::string::npos) << why;
  EXPECT_NE(reason("[sensro]\nwidth = 3\n").find("'sensor.width'"), std::string::npos);
  EXPECT_NE(reason("sed = 3\n").find("'seed'"), std::string::npos);
  EXPECT_NE(reason("[map.resolution]\nx = 3\n"), "");
  EXPECT_NE(reason("[[map]]\nresolution = 3\n"), "");
}

TEST_F(ConfigurationFile, WrongTypesNameTheKeyAndTheLine) {
  for (const auto& [text, key] :
       std::vector<std::pair<std::string, std::string>>{{"seed = true", "seed"},
                                                        {"seed = 1.5", "seed"},
                                                        {"seed = -1", "seed"},
                                                        {"seed = '1'", "seed"},
                                                        {"sensor.width = '640'", "sensor.width"},
                                                        {"sensor.width = 640.5", "sensor.width"},
                                                        {"sensor.width = [640]", "sensor.width"},
                                                        {"sensor.width = 99999999999", "sensor.width"},
                                                        {"map.resolution = 'fine'", "map.resolution"},
                                                        {"map.resolution = true", "map.resolution"},
                                                        {"map.resolution = 2020-01-01", "map.resolution"},
                                                        {"evaluation.enabled = 1", "evaluation.enabled"},
                                                        {"evaluation.enabled = 'true'", "evaluation.enabled"},
                                                        {"object.file = 5", "object.file"},
                                                        {"object.file = true", "object.file"},
                                                        {"views.layout = 1", "views.layout"},
                                                        {"views.layout = 'cube'", "views.layout"},
                                                        {"sensor.preset = 5", "sensor.preset"}}) {
    const std::string why = reason("\n" + text + "\n");
    EXPECT_NE(why, "") << text;
    EXPECT_NE(why.find(key), std::string::npos) << text << ": " << why;
    EXPECT_NE(why.find(":2:"), std::string::npos) << text << ": " << why;
  }
}

TEST_F(ConfigurationFile, WholeNumbersDoForNumbers) {
  EXPECT_EQ(read("map.resolution = 1\n").map.resolution, 1.0);
  EXPECT_EQ(read("map.resolution = 1e-2\n").map.resolution, 0.01);
}

TEST_F(ConfigurationFile, ANumberMayHaveItsUnitInQuotes) {
  EXPECT_EQ(read("map.resolution = '5 mm'\n").map.resolution, 0.005);
  EXPECT_EQ(read("map.resolution = '0.01'\n").map.resolution, 0.01);
  EXPECT_EQ(read("sensor.field_of_view = '45 deg'\n").sensor.field_of_view, 45.0);
  EXPECT_NE(reason("map.resolution = '5 parsec'\n").find("parsec"), std::string::npos);
}

TEST_F(ConfigurationFile, BrokenTomlNamesTheLine) {
  EXPECT_NE(reason("seed = 1\nseed = 2\n").find(":2:"), std::string::npos);
  for (const char* bad : {"seed", "seed =", "= 1", "[sensor", "seed = 1 2", "\"", "seed = '", "a = {b = ", "[]",
                          "\x80\xff", "seed = 0x", "seed = 1__0", "seed = 99999999999999999999"})
    EXPECT_NE(reason(bad), "") << bad;
  EXPECT_NE(reason(std::string("seed = 1\0\n", 10)), "");
}

TEST_F(ConfigurationFile, HostileFilesAreRefused) {
  const int many = 100'000;
  std::string dotted = "a", arrays = "a = ", tables = "a = ", header = "[a";
  for (int n = 0; n < many; ++n) dotted += ".a", arrays += "[", tables += "{a=", header += ".a";
  for (const std::string& text : {dotted + " = 1\n", arrays, tables, header + "]\nb = 1\n", std::string(many, '['),
                                  std::string(2 << 20, '\n'), std::string(2 << 20, 'a')})
    EXPECT_NE(reason(text), "") << text.substr(0, 20);
  for (const std::filesystem::path& path : {folder_, folder_ / "missing.toml", std::filesystem::path("/dev/zero")})
    EXPECT_THROW(read_configuration(path), std::runtime_error) << path;
}

TEST_F(ConfigurationFile, FlippedBytesAreReadOrRefused) {
  const std::string good = default_toml();
  std::mt19937 random(1);
  for (int n = 0; n < 400; ++n) {
    std::string bad = good;
    for (unsigned k = 0; k <= random() % 4; ++k) bad[random() % bad.size()] = char(random());
    reason(n % 4 ? bad : bad.substr(0, random() % bad.size()));
  }
}

TEST(ResolveObject, FindsPathsAndNames) {
  const auto objects = std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/objects";
  EXPECT_TRUE(std::filesystem::equivalent(resolve_object((objects / "box.ply").string()), objects / "box.ply"));
  EXPECT_TRUE(std::filesystem::equivalent(resolve_object("box"), objects / "box.ply"));
  EXPECT_TRUE(std::filesystem::equivalent(resolve_object("box.ply"), objects / "box.ply"));
  EXPECT_TRUE(std::filesystem::exists(resolve_object("")));
  EXPECT_THROW(resolve_object("no such thing"), std::runtime_error);
}

TEST_F(ConfigurationFile, WhatComesWithTheProgramIsMissedByItsFolder) {
  const char* const before = std::getenv("NEXTVIEW_ASSETS");
  const std::string was = before ? before : "", empty = std::filesystem::path(folder_).string();
  ::setenv("NEXTVIEW_ASSETS", empty.c_str(), 1);
  EXPECT_EQ(complaint([] { resolve_object("box"); }),
            "box: comes with the program, but is not in " + empty +
                "/objects; install the program whole, or set NEXTVIEW_ASSETS to its folder assets");
  before ? ::setenv("NEXTVIEW_ASSETS", was.c_str(), 1) : ::unsetenv("NEXTVIEW_ASSETS");
}

TEST_F(ConfigurationFile, WhatMakesNoSenseNamesItsPlace) {
  std::ofstream(file()) << "[sensor]\nrange_noise = 5\n";
  EXPECT_EQ(complaint([&] { read_configuration(file()); }),
            file().string() + ":2: sensor.range_noise must be from 0 to 1 m, not 5 m");
  Configuration configuration;
  read_settings(file(), configuration);
  EXPECT_EQ(configuration.sources,
            (SettingSources{{"sensor.range_noise", {"sensor.range_noise", file().string() + ":2", "5"}}}));
  configuration.sensor.range_noise = 7;
  EXPECT_EQ(complaint([&] { configuration.validate(); }), "sensor.range_noise must be from 0 to 1 m, not 7 m")
      << "that is not what the file says";
  configuration.sensor.range_noise = 0.5;
  EXPECT_NO_THROW(configuration.validate());
}

TEST_F(ConfigurationFile, SettingsThatDoNotGoTogetherAreAllNamedAsTheyWereGiven) {
  Configuration configuration = read("[sensor]\nmin_range = 0.5\n");
  give(configuration, "sensor.max_range", "0.25", "--sensor.max_range");
  EXPECT_EQ(complaint([&] { configuration.validate(); }),
            file().string() + ":2: sensor.min_range, 0.5 m, must be at most --sensor.max_range, 0.25 m");
  give(configuration, "sensor.min_range", "0.5", "min range (sensor.min_range)");  // as the window does
  EXPECT_EQ(complaint([&] { configuration.validate(); }),
            "min range (sensor.min_range), 0.5 m, must be at most --sensor.max_range, 0.25 m");
  // One of them is the default.
  for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
           {"map.clamp_max = 0.51\nmap.occupancy_threshold = 0.6",
            ":2: map.occupancy_threshold, 0.6, must lie between map.clamp_min, 0.12, and map.clamp_max (FILE:1), 0.51"},
           {"\nmap.free_below = 0.9", ":2: map.free_below, 0.9, must be below map.occupied_above, 0.8"},
           {"views.layout = 'file'", ":1: views.file must name a views file where views.layout is file"},
           {"views.layout = 'rings'\nviews.rings = 99", ":2: views.rings, 99, must be at most views.count, 48"},
           {"gibbs.random_weight = 0.99",
            ":1: gibbs.random_weight, 0.99, and gibbs.max_weight, 0.05, must leave something for hits: together they "
            "must be below 1"},
           {"gibbs.attenuations = '2, 1'",
            ":1: gibbs.attenuations must be one to 5 ascending numbers over 0, up to 50"},
           {"gibbs.attenuations = 'x'", ":1: gibbs.attenuations takes numbers with commas, not 'x'"},
           {"planner.combined_weights = 'x=1'", ":1: planner.combined_weights: there is no gain 'x'; there are"},
           {"planner.gain = 'gibbs'\nplanner.semantics = 'reference'",
            ":1: planner.gain gibbs needs planner.semantics (FILE:2) published: the reference code knows no Gibbs map"},
           {"evaluation.enabled = false\nplanner.gain = 'oracle'",
            ":2: planner.gain oracle knows the mesh: it needs evaluation.enabled"},
           {"map.hit_decay = 1\nplanner.semantics = 'reference'",
            ":1: map.hit_decay and map.miss_decay must be 0 with planner.semantics (FILE:2) reference, whose map "
            "knows no range"},
           {"map.region_edge = 1.28\nmap.resolution = 1e-4",
            ":1: map.region_edge / map.resolution (FILE:2) must be from 1 to 1024 voxels, not 12800: make"},
           {"map.region_edge = 1.28\nmap.resolution = 1e-5",
            ":1: map.region_edge / map.resolution (FILE:2) must be from 1 to 1024 voxels, not 128000: make"}}) {
    const Configuration bad = read(text);
    std::string expected = "FILE" + reason;
    for (std::size_t at; (at = expected.find("FILE")) != expected.npos;) expected.replace(at, 4, file().string());
    EXPECT_THAT(complaint([&] { bad.validate(); }), testing::StartsWith(expected)) << text;
  }
}

// Settings that were written down elsewhere, as in a picture or a journal: what makes no sense is refused as in a file.
TEST_F(ConfigurationFile, ATextIsTakenAsThatFileWouldBe) {
  const Configuration good = configuration_of("seed = 5\n[sensor]\nwidth = 77\n", file());
  EXPECT_EQ(good.seed, 5u);
  EXPECT_EQ(good.sensor.width, 77);
  EXPECT_EQ(good.read_from, std::vector<std::filesystem::path>{file()});
  EXPECT_EQ(good.sources.at("sensor.width").place, file().string() + ":3");
  const std::string apart = "[sensor]\nmin_range = 0.5\nmax_range = 0.25\n";
  for (const std::string& text : {apart, std::string("[sensor]\nrange_noise = 5\n"), std::string("sed = 5\n")}) {
    std::ofstream(file(), std::ios::binary) << text;
    const std::string of_file = complaint([&] { read_configuration(file()); });
    EXPECT_NE(of_file, "") << text;
    EXPECT_EQ(complaint([&] { configuration_of(text, file()); }), of_file);
  }
}

// A picture's text may be longer than any file that is read: taken apart, this one would overflow the stack.
TEST_F(ConfigurationFile, ATextThatNestsTooDeepIsRefused) {
  std::string deep = "a";
  for (int i = 0; i < 500'000; ++i) deep += ".a";
  EXPECT_THAT(complaint([&] { configuration_of(deep + " = 1\n", file()); }),
              testing::HasSubstr("bytes of settings; at most 32768 are read"));
  EXPECT_FALSE(is_study(deep + " = 1\n"));
}

// What of its text is a study's is told by its tables, wherever their names stand else.
TEST_F(ConfigurationFile, AStudyIsKnownByItsBlocks) {
  EXPECT_TRUE(is_study("[[ planning ]]\nobjects = ['box']\n"));
  EXPECT_TRUE(is_study("name = 's'\nmaps = [{objects = ['box']}]\n"));
  for (const char* none : {"", "seed = 1", "# [[planning]]\nseed = 1\n", "map.start = '[[maps]]'\n", "[[maps"})
    EXPECT_FALSE(is_study(none)) << none;
}

}  // namespace
}  // namespace nextview
