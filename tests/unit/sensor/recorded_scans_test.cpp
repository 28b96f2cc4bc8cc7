#include "core/sensor/recorded_scans.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <iostream>
#include <sstream>

#include "tests/data/conformance.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string good =
    "param resolution_m 0.01\n"
    "param fx 448.1\r\n"
    "\n"
    "scan 1 2 3 0 0 0.70710678118654757 0.70710678118654757 2\n"
    "0.5 -0.25 1e-1\n"
    "  3 4\t5  \n"
    "scan 0 0 0 0 0 0 1 0\n"
    "view -1 -2 -3 0 0 0 1.0005\n"
    "view 0 0 0 1 0 0 0";

TEST(RecordedScans, everyPartIsRead) {
  const TemporaryFolder folder;
  const RecordedScene scene = read_recorded_scene(folder.write("scene.txt", good));
  EXPECT_EQ(scene.parameters, (std::map<std::string, double>{{"resolution_m", 0.01}, {"fx", 448.1}}));
  ASSERT_EQ(scene.scans.size(), 2u);
  ASSERT_EQ(scene.scans[0].points.size(), 2u);
  EXPECT_EQ(scene.scans[0].points[0], Vector3(0.5, -0.25, 0.1));
  EXPECT_EQ(scene.scans[0].points[1], Vector3(3, 4, 5));
  EXPECT_TRUE(scene.scans[1].points.empty());
  // A quarter turn about z takes x to y.
  EXPECT_LT((scene.scans[0].T_world_camera * Vector3(1, 0, 0) - Vector3(1, 3, 3)).norm(), 1e-12);
  ASSERT_EQ(scene.views.size(), 2u);
  EXPECT_LT((scene.views[0] * Vector3(1, 1, 1) - Vector3(0, -1, -2)).norm(), 1e-12) << "the quaternion is normalised";
  EXPECT_LT((scene.views[1] * Vector3(0, 1, 0) - Vector3(0, -1, 0)).norm(), 1e-12);
}

TEST(RecordedScans, aCompressedOneIsReadAsItIs) {
  EXPECT_FALSE(read_recorded_scene(conformance_file("scans1.txt.gz")).scans.empty());
}

/// The message, after checking that it is one line that begins with the file's name.
std::string complaint(const std::filesystem::path& file) {
  try {
    read_recorded_scene(file);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_THAT(message, StartsWith(file.string() + ":"));
    return message.substr(std::min(message.size(), file.string().size()));
  }
  return "no complaint";
}

TEST(RecordedScans, whatIsNoFileSaysWhy) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder / "nowhere.txt"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "folder");
  EXPECT_THAT(complaint(folder / "folder"), HasSubstr("Is a directory"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(complaint(folder / "pipe"), HasSubstr("is a pipe")) << "nobody writes to it: reading it would not end";
  EXPECT_THAT(complaint("/dev/zero"), HasSubstr("device"));
  EXPECT_THAT(complaint(folder.write("empty.txt", "")), EndsWith("is empty"));
  EXPECT_THAT(complaint(folder.write("blank.txt", "\n \n")), HasSubstr("no scan"));
  EXPECT_THAT(complaint(folder.write("views.txt", "view 0 0 0 0 0 0 1\n")), HasSubstr("no scan"));
}

TEST(RecordedScans, whatIsWrongIsNamedWithItsLine) {
  const TemporaryFolder folder;
  struct Wrong {
    const char *line, *instead, *where, *reason;
  };
  for (const auto& [line, instead, where, reason] : std::vector<Wrong>{
           {"param fx 448.1", "param fx", ":2:", "param NAME VALUE"},
           {"param fx 448.1", "param fx nan", ":2:", "finite"},
           {"param fx 448.1", "param fx 1 2", ":2:", "more than"},
           {"param fx 448.1", "param resolution_m 1", ":2:", "twice"},
           {"param fx 448.1", "parameter fx 1", ":2:", "expected a line"},
           {"0.5 -0.25 1e-1", "0.5 -0.25", ":5:", "x y z"},
           {"0.5 -0.25 1e-1", "0.5 -0.25 inf", ":5:", "finite"},
           {"0.5 -0.25 1e-1", "0.5 -0.25 1e999", ":5:", "finite"},
           {"0.5 -0.25 1e-1", "0.5 -0.25 0.1m", ":5:", "apart"},
           {"0.5 -0.25 1e-1", "0.5,-0.25,0.1", ":5:", "apart"},
           {"0.5 -0.25 1e-1", "0.5 -0.25 1 1", ":5:", "more than"},
           {"0.5 -0.25 1e-1", "scan 0 0 0 0 0 0 1 0", ":5:", "x y z"},
           {"  3 4\t5  ", "", ":7:", "x y z"},
           {"0 0 0.70710678118654757 0.70710678118654757 2", "0 0 0.5 0.5 2", ":4:", "length 0.7"},
           {"0.70710678118654757 2", "0.70710678118654757 1", ":6:", "expected a line"},
           {"0.70710678118654757 2", "0.70710678118654757", ":4:", "count"},
           {"0.70710678118654757 2", "0.70710678118654757 -2", ":4:", "count"},
           {"0.70710678118654757 2", "0.70710678118654757 2.5", ":4:", "apart"},
           {"0.70710678118654757 2", "0.70710678118654757 2000000000", ":4:", "claims 2000000000 points"},
           {"0.70710678118654757 2", "0.70710678118654757 99999999999999999999", ":4:", "count"},
           {"0 0 0 1.0005", "0 0 0 1.0015", ":8:", "length 1.0015"},
           {"0 0 0 1.0005", "0 0 0", ":8:", "view px py pz"},
           {"view 0 0 0 1 0 0 0", "view 0 0 0 0 0 0 0", ":9:", "length 0"}}) {
    std::string text = good;
    text.replace(text.find(line), std::string_view(line).size(), instead);
    const std::string said = complaint(folder.write("scene.txt", text));
    EXPECT_THAT(said, StartsWith(where)) << instead;
    EXPECT_THAT(said, HasSubstr(reason)) << instead;
  }
}

// A count that the rest of the file cannot hold is refused before memory is taken for it: a point takes six characters
// at least, and the last line may lack its end.
TEST(RecordedScans, pointsAreAtMostWhatTheFileHasRoomFor) {
  const TemporaryFolder folder;
  const auto scene = [&](std::size_t claimed, std::size_t points, const char* behind = "") {
    std::string text = "scan 0 0 0 0 0 0 1 " + std::to_string(claimed) + "\n";
    for (std::size_t i = 0; i < points; ++i) text += i + 1 < points ? "0 0 0\n" : "0 0 0";
    return folder.write("scene.txt", text + behind);
  };
  for (const char* behind : {"", "\n"}) {
    EXPECT_EQ(read_recorded_scene(scene(1, 1, behind)).scans[0].points.size(), 1u);
    EXPECT_EQ(read_recorded_scene(scene(9, 9, behind)).scans[0].points.size(), 9u);
    for (const std::size_t claimed : {10u, 20u, 100u, 1000u})
      EXPECT_THAT(complaint(scene(claimed, 9, behind)),
                  HasSubstr("claims " + std::to_string(claimed) + " points, more than the rest of the file can hold"));
  }
  EXPECT_THAT(complaint(scene(2, 1, "\n      ")), HasSubstr("ends after 1 of 2 points")) << "there is room for it";
}

TEST(RecordedScans, truncatedOrGarbage) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder.write("cut.txt", good.substr(0, good.find("  3 4")))),
              HasSubstr("ends after 1 of 2 points"));
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes.push_back(static_cast<char>(i * 37));
  EXPECT_THAT(complaint(folder.write("garbage.txt", bytes)), StartsWith(": is no scene"));
}

TEST(RecordedScans, aTextThatIsNoSceneIsToldSoAndWhatIsRead) {
  const TemporaryFolder folder;
  const std::string said = complaint(folder.write("list.txt", "\nmilk\nbread\n"));
  EXPECT_THAT(said, StartsWith(": is no scene"));
  EXPECT_THAT(said, HasSubstr("(.stl, .ply"));
  EXPECT_THAT(said, testing::Not(HasSubstr("px py pz")));
}

TEST(RecordedScans, theConformanceScenesAreReadWhole) {
  const TemporaryFolder folder;
  for (const auto& [name, scans] : std::vector<std::pair<std::string, std::size_t>>{{"scans1", 1}, {"scans6", 6}}) {
    const std::filesystem::path file = unpack_conformance_scene(name, folder / "");
    const auto start = std::chrono::steady_clock::now();
    const RecordedScene scene = read_recorded_scene(file);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    std::cout << name << ": read in " << took.count() << " ms\n";
    EXPECT_EQ(scene.scans.size(), scans);
    EXPECT_EQ(scene.views.size(), 48u);
    // Again with streams, slowly: every number of every point.
    std::ifstream in(file);
    std::size_t scan = 0, left = 0, point = 0;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      if (left > 0) {
        Vector3 p;
        words >> p.x() >> p.y() >> p.z();
        ASSERT_EQ(scene.scans.at(scan - 1).points.at(point++), p);
        --left;
      } else if (line.starts_with("scan")) {
        std::string word;
        for (int i = 0; i < 9; ++i) words >> word;
        left = std::stoul(word);
        ASSERT_EQ(scene.scans.at(scan++).points.size(), left);
        point = 0;
      } else if (line.starts_with("param")) {
        std::string word, key;
        double value;
        words >> word >> key >> value;
        ASSERT_EQ(scene.parameters.at(key), value);
      }
    }
    EXPECT_EQ(scan, scans);
  }
}

// Single precision cannot hold it, and a map was walked without end in search of it.
TEST(RecordedScans, pointsAtTheEndOfTheWorldAreRefused) {
  const TemporaryFolder folder;
  const std::string head = "scan 0 0 0 0 0 0 1 2\n0 0 1\n";
  for (const char* point : {"1e39 0 0", "0 -1e39 0", "0 0 1e308", "0 1.1e6 0", "-1e19 1e19 0"})
    EXPECT_THAT(complaint(folder.write("scene.txt", head + point + "\n")),
                HasSubstr(":3: the point lies beyond 1e+06 m from the sensor"))
        << point;
  for (const char* point : {"1e6 0 0", "-0.0 4.9e-324 0", "1e-300 -0 1e-45"})
    EXPECT_EQ(read_recorded_scene(folder.write("scene.txt", head + point + "\n")).scans[0].points.size(), 2u) << point;
}

}  // namespace
}  // namespace nextview
