#include "core/results/output_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/config/configuration.hpp"
#include "core/file/atomic_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class OutputFolders : public InTemporaryFolder {
 protected:
  fs::path write(const fs::path& name, const std::string& content = "mine") const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, content);
    return folder_ / name;
  }
  bool there(const fs::path& name) const { return fs::exists(fs::symlink_status(folder_ / name)); }
  nlohmann::json manifest() const { return nlohmann::json::parse(read_file(folder_ / "out" / "manifest.json")); }
  void write_hostile_manifest(const std::vector<std::string>& names) const {
    write("out/manifest.json", nlohmann::json{{"program", "nextview 9"}, {"command", "scan"}, {"files", names}}.dump());
  }
  /// What keeps an input from being replaced; empty if nothing does.
  std::string refusal(const fs::path& input, const fs::path& out = "out") const {
    try {
      OutputFolder(folder_ / out, std::vector<InputFile>{{input, "the object"}});
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
};

TEST_F(OutputFolders, OfManyFramesAreKnownAgain) {
  fs::create_directories(folder_ / "out");
  Manifest manifest{"nextview 9", "demo", std::nullopt, {}};
  for (int number = 1; number <= 60'000; ++number) manifest.files.push_back(fmt::format("frame_{:05}.png", number));
  write_manifest(manifest, folder_ / "out");
  const auto read = read_manifest(folder_ / "out");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->files, manifest.files);
}

TEST_F(OutputFolders, ThatNothingWasWrittenToAreGoneAgain) {
  write("there/mine.txt");
  { const MadeFolder made(folder_ / "there" / "a" / "b"); }
  EXPECT_FALSE(there("there/a"));
  EXPECT_TRUE(there("there/mine.txt"));
  {
    const MadeFolder made(folder_ / "out" / "b");
    write("out/result.txt");
  }
  EXPECT_FALSE(there("out/b"));
  EXPECT_TRUE(there("out/result.txt"));
  { const MadeFolder made(folder_ / "there"); }
  EXPECT_TRUE(there("there")) << "it was there before";
  EXPECT_THROW(MadeFolder(folder_ / "there" / "mine.txt"), std::runtime_error);
}

TEST_F(OutputFolders, RefuseToReplaceAnInputByWhateverNameItIsGiven) {
  const fs::path object = write("out/surface_map.ply");
  fs::create_symlink("out", folder_ / "link");
  fs::create_symlink("out/surface_map.ply", folder_ / "part.ply");
  fs::create_hard_link(object, folder_ / "hard.ply");
  fs::create_directories(folder_ / "other");
  fs::create_symlink("../out/surface_map.ply", folder_ / "other" / "cloud.ply");
  for (const fs::path spelling :
       {"out/surface_map.ply", "out/../out/surface_map.ply", "link/surface_map.ply", "part.ply", "hard.ply"})
    for (const char* out : {"out", "link", "./out/", "other/../out", "other"})
      EXPECT_THAT(refusal(folder_ / spelling, out), AllOf(HasSubstr((folder_ / spelling).string() + ": is the object"),
                                                          HasSubstr("--out "), Not(HasSubstr("\n"))))
          << spelling << " " << out;
  EXPECT_THAT(refusal(object), HasSubstr("--out " + (folder_ / "out-2").string()));
  fs::create_directories(folder_ / "out-2");
  EXPECT_THAT(refusal(object), HasSubstr("--out " + (folder_ / "out-3").string()));
  EXPECT_EQ(read_file(object), "mine");
}

TEST_F(OutputFolders, AreNoLinkToWhatIsNotThere) {
  fs::create_directory_symlink(folder_ / "gone", folder_ / "link");
  const fs::path input = write("part.stl");
  EXPECT_THAT(refusal(input, "link"), HasSubstr("link: is a link to what is not there; remove it, or give another"));
  fs::create_directory(folder_ / "gone");
  EXPECT_EQ(refusal(input, "link"), "");
}

TEST_F(OutputFolders, TakeInputsUnderNamesThatAreNeverWrittenAndLeaveThemAlone) {
  const fs::path part = write("out/part.ply"), other = write("part.json");
  EXPECT_EQ(refusal(part), "");
  EXPECT_EQ(refusal(other), "");
  EXPECT_EQ(refusal(folder_ / "not there"), "");
  EXPECT_NE(refusal(write("out/step_07.png")), "");
  EXPECT_EQ(refusal(write("out/step_7.png")), "") << "no step is numbered so";
  EXPECT_NE(refusal(folder_ / "out"), "") << "the folder itself";
  begun(folder_ / "out");
  begun(folder_ / "out");
  EXPECT_EQ(read_file(part), "mine");
}

TEST_F(OutputFolders, RemoveWhatIsOnTheirListAndNothingElse) {
  {
    OutputFolder out = begun(folder_ / "out");
    for (const char* name : {"map.ot", "step_01.png", "step_02.png"}) write_file(out.claim(name), "ours");
    out.claim("cloud.ply");  // a run that was killed before it wrote it
  }
  EXPECT_EQ(manifest()["files"], nlohmann::json({"map.ot", "step_01.png", "step_02.png", "cloud.ply"}));
  write("out/notes.txt");
  write("out/step_03.png");
  write("out/surfaces.json");
  begun(folder_ / "out");
  for (const char* name : {"out/map.ot", "out/step_01.png", "out/step_02.png"}) EXPECT_FALSE(there(name)) << name;
  for (const char* name : {"out/notes.txt", "out/step_03.png", "out/surfaces.json"}) EXPECT_TRUE(there(name)) << name;
  EXPECT_EQ(manifest()["files"].size(), 0u);
}

TEST_F(OutputFolders, AManifestOfWhateverOriginRemovesNothingElse) {
  write("victim.txt");
  write("map.ot");
  write("out/thesis.docx");
  write("out/sub/map.ot");
  write("elsewhere/map.ot");
  fs::create_directories(folder_ / "out" / "cloud.ply");
  fs::create_symlink("../victim.txt", folder_ / "out" / "map.bt");
  write_hostile_manifest({"../victim.txt", "../map.ot", (folder_ / "map.ot").string(), "thesis.docx", "sub/map.ot",
                          "./thesis.docx", "", ".", "..", "cloud.ply", "map.bt", "step_01.png/../thesis.docx",
                          std::string("map.ot\0x", 8), "step_.png", "step_0001.png", "step_aa.png", "STEP_01.PNG"});
  begun(folder_ / "out");
  for (const char* name :
       {"victim.txt", "map.ot", "out/thesis.docx", "out/sub/map.ot", "elsewhere/map.ot", "out/cloud.ply", "out/map.bt"})
    EXPECT_TRUE(there(name)) << name;
}

TEST_F(OutputFolders, LeaveAManifestThatIsNotOursAndSaySo) {
  for (const char* text : {"", "{}", "[1]", "{\"program\": \"web\", \"command\": \"x\", \"files\": []}", "\xff\xfe",
                           "{\"program\": \"nextview 1\", \"command\": \"scan\"}",
                           "{\"program\": \"nextview 1\", \"command\": \"scan\", \"files\": 7}"}) {
    write("out/manifest.json", text);
    EXPECT_THAT(refusal(folder_ / "x"), AllOf(HasSubstr("out/manifest.json"), Not(HasSubstr("\n")))) << text;
    EXPECT_EQ(read_file(folder_ / "out" / "manifest.json"), text);
  }
}

TEST_F(OutputFolders, OfVersionsWithoutAListAreKnownByTheirTables) {
  const auto fill = [&](const char* config, const std::string& steps) {
    fs::remove_all(folder_ / "out");
    for (const char* name : {"map.ot", "step_01.png", "step_20.png", "views.csv", "conventional.ot", "my.png"})
      write(fs::path("out") / name);
    write(fs::path("out") / config);
    write("out/steps.csv", steps);
    begun(folder_ / "out");
  };
  fill("config.toml", "step,view,overridden\n");
  for (const char* name : {"out/map.ot", "out/step_01.png", "out/step_20.png", "out/views.csv", "out/steps.csv"})
    EXPECT_FALSE(there(name)) << name;
  EXPECT_TRUE(there("out/my.png"));
  EXPECT_TRUE(there("out/conventional.ot")) << "no scan wrote it";
  for (const auto& [config, steps] :
       {std::pair("my.toml", "step,view,overridden\n"), {"config.toml", "time,steps\n"}, {"config.toml", ""}}) {
    fill(config, steps);
    for (const char* name : {"out/map.ot", "out/step_01.png", "out/steps.csv"}) EXPECT_TRUE(there(name)) << name;
  }
}

TEST_F(OutputFolders, NameWhatLiesInsideRelativelyAndTheRestAbsolutely) {
  const fs::path inside = write("out/parts/a.ply"), outside = write("out2/b.ply");
  EXPECT_EQ(named_from(folder_ / "out", inside), "parts/a.ply");
  EXPECT_EQ(named_from(folder_ / "out", folder_ / "out2" / ".." / "out2" / "b.ply"), outside.string());
  fs::create_symlink("out2", folder_ / "link");
  EXPECT_EQ(named_from(folder_ / "out", folder_ / "link" / "b.ply"), (folder_ / "link" / "b.ply").string());
  fs::create_symlink("../out2/b.ply", folder_ / "out" / "b.ply");
  EXPECT_EQ(named_from(folder_ / "out", folder_ / "out" / "b.ply"), (folder_ / "out" / "b.ply").string())
      << "the target lies outside";
}

TEST_F(OutputFolders, AConfigurationIsReadBackFromAnywhere) {
  write("out/part.ply");
  write("views.txt");
  write("mine.toml", "[sensor]\nwidth = 99\n");
  Configuration c;
  c.object.file = (folder_ / "out" / "part.ply").string();
  c.views.layout = ViewLayout::file;
  c.views.file = (folder_ / "views.txt").string();
  apply_sensor_preset(c, (folder_ / "mine.toml").string());
  write("out/config.toml", to_toml(c, folder_ / "out"));
  EXPECT_THAT(read_file(folder_ / "out" / "config.toml"), HasSubstr("file = 'part.ply'"));
  const Configuration again = read_configuration(folder_ / "out" / "config.toml");
  EXPECT_TRUE(fs::equivalent(again.object.file, c.object.file)) << again.object.file;
  EXPECT_EQ(again.views.file, c.views.file);
  EXPECT_EQ(again.sensor_preset, c.sensor_preset);
  EXPECT_THAT(again.read_from, ElementsAre(folder_ / "mine.toml", folder_ / "out" / "config.toml"));
  fs::rename(folder_ / "out", folder_ / "moved");
  EXPECT_TRUE(fs::equivalent(read_configuration(folder_ / "moved" / "config.toml").object.file,
                             folder_ / "moved" / "part.ply"));
  for (const char* name : {"", "bunny", "gearbox", "box", "paper"}) {  // no paths, and no files here
    c.object.file = c.sensor_preset = name;
    const std::string text = to_toml(c, folder_);
    EXPECT_THAT(text,
                AllOf(HasSubstr(fmt::format("file = '{}'", name)), HasSubstr(fmt::format("preset = '{}'", name))));
  }
}

TEST_F(OutputFolders, KnowWhetherTheObjectIsTheSame) {
  const fs::path object = write("part.ply", "one"), same = write("copy.ply", "one");
  OutputFolder out(folder_ / "out", {});
  require_same_object(folder_ / "out", object);  // no list says anything else
  out.begin("scan", object);
  EXPECT_EQ(manifest()["object"]["file"], object.string());
  EXPECT_NO_THROW(require_same_object(folder_ / "out", object));
  EXPECT_NO_THROW(require_same_object(folder_ / "out", same)) << "wherever it has gone";
  write("part.ply", "two");
  try {
    require_same_object(folder_ / "out", object);
    ADD_FAILURE() << "the change was not noticed";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(object.string()), HasSubstr((folder_ / "out").string())));
  }
}

}  // namespace
}  // namespace nextview
