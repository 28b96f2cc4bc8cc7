// A folder of results that goes on, or goes away; and the names that results have.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file/atomic_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"

namespace nextview {
namespace {

class GoingOn : public InTemporaryFolder {
 protected:
  bool there(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  nlohmann::json listed() const { return nlohmann::json::parse(read_file(folder_ / "out" / manifest_name)); }
  std::vector<std::string> files() const { return listed()["files"]; }
};
using Names = std::vector<std::string>;

TEST_F(GoingOn, KeepsWhatIsThereAndItsList) {
  OutputFolder(folder_ / "out", {}).go_on("scan");
  EXPECT_EQ(listed()["command"], "scan") << "the list is there before anything is written";
  EXPECT_EQ(files(), Names());
  {
    OutputFolder out(folder_ / "out", {});
    out.go_on("refine");
    write_file(out.claim("map.ot"), "ours");
    out.claim("map.ot");
  }
  EXPECT_EQ(listed()["command"], "scan") << "what began it";
  EXPECT_EQ(files(), Names{"map.ot"}) << "each once";
  OutputFolder out(folder_ / "out", {});
  out.go_on("scan");
  EXPECT_TRUE(there("out/map.ot"));
  EXPECT_EQ(out.claim("cloud.ply"), folder_ / "out/cloud.ply");
  EXPECT_EQ(files(), (Names{"map.ot", "cloud.ply"}));
}

TEST_F(GoingOn, RemovedItLeavesNothingButWhatIsOthers) {
  for (const bool has_others : {false, true}) {
    OutputFolder out = begun(folder_ / "out");
    std::filesystem::create_directories(folder_ / "out/scans");
    for (const char* name : {"map.ot", "scans/0001.npy", "step_01.png"}) write_file(out.claim(name), "ours");
    if (has_others) write_file(folder_ / "out/notes.txt", "mine");
    out.remove();
    EXPECT_EQ(there("out"), has_others);
    EXPECT_EQ(there("out/notes.txt"), has_others);
    for (const char* name : {"out/map.ot", "out/scans", "out/step_01.png", "out/manifest.json"})
      EXPECT_FALSE(there(name)) << name;
  }
}

TEST(ResultNames, AreThoseThatAreWritten) {
  for (const char* name :
       {"map.ot", "manifest.json", "step_01.png", "step_99.png", "step_100.png", "step_123456789.png",
        "frame_00001.png", "frame_100000.png", "scans/0001.npy", "scans/9999.ply", "scans/10000.npy"})
    EXPECT_TRUE(is_result_name(name)) << name;
  for (const char* name : {"",
                           "map.otx",
                           "xmap.ot",
                           "step_1.png",
                           "step_001.png",
                           "step_.png",
                           "step_0a.png",
                           "step_01.jpg",
                           "step_01png",
                           "step_1234567890.png",
                           "frame_0001.png",
                           "frame_000001.png",
                           "scans/001.npy",
                           "scans/00001.npy",
                           "scans/0001.txt",
                           "scans/",
                           "0001.npy",
                           "scans/0001.npy/",
                           "xstep_01.png",
                           "step_01.png.png"})
    EXPECT_FALSE(is_result_name(name)) << name;
}

}  // namespace
}  // namespace nextview
