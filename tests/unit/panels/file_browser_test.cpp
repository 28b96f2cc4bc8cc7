#include "ui/panels/file_browser.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class FileBrowserTest : public testing::Test {
 protected:
  FileBrowserTest() {
    for (const char* name :
         {"parts/bracket.stl", "parts/brace.ply", "parts/.hidden", "parts/Zebra.obj", "parts/older/x"}) {
      std::filesystem::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name) << "12345";
    }
    browser_.go_to(folder_ / "parts");
  }
  std::vector<std::string> names(std::string_view written) const {
    std::vector<std::string> result;
    for (const std::size_t i : browser_.matching(written)) result.push_back(browser_.entries()[i].name);
    return result;
  }

  TemporaryFolder folder_;
  FileBrowser browser_;
};

TEST_F(FileBrowserTest, FoldersComeFirstAndHiddenOnesOnlyIfAskedFor) {
  EXPECT_THAT(names(""), ElementsAre("older", "brace.ply", "bracket.stl", "Zebra.obj"));
  EXPECT_THAT(names(".h"), ElementsAre(".hidden"));
  EXPECT_THAT(names("BRAC"), ElementsAre("brace.ply", "bracket.stl"));
  EXPECT_THAT(names("nothing"), ElementsAre());
  EXPECT_EQ(browser_.entries()[browser_.matching("stl").front()].bytes, 5u);
}

TEST_F(FileBrowserTest, ATabAddsWhatAllHaveInCommon) {
  EXPECT_EQ(browser_.completed("b"), "brac");
  EXPECT_EQ(browser_.completed("brack"), "bracket.stl");
  EXPECT_EQ(browser_.completed("ol"), "older/");
  EXPECT_EQ(browser_.completed("older/"), "older/x");
  EXPECT_EQ(browser_.completed("q"), "q");
  EXPECT_EQ(browser_.completed((folder_ / "par").string()), (folder_ / "parts/").string());
}

TEST_F(FileBrowserTest, ANameIsMeantHereAndAPathWhereItSays) {
  EXPECT_EQ(browser_.meant("brace.ply"), folder_ / "parts/brace.ply");
  EXPECT_EQ(browser_.meant("/else/where"), "/else/where");
  setenv("HOME", "/home/of mine", 1);
  EXPECT_EQ(browser_.meant("~/scan"), "/home/of mine/scan");
}

TEST_F(FileBrowserTest, FoldersOfAPathAreLookedIntoIfTheyAreThere) {
  EXPECT_EQ(browser_.enter("older"), "older");
  EXPECT_EQ(browser_.folder(), folder_ / "parts");
  EXPECT_EQ(browser_.enter("older/x"), "x");
  EXPECT_EQ(browser_.folder(), folder_ / "parts/older");
  EXPECT_EQ(browser_.enter("../br"), "br");
  EXPECT_EQ(browser_.folder(), folder_ / "parts");
  EXPECT_EQ(browser_.enter("gone/x"), "gone/x");
  EXPECT_EQ(browser_.enter((folder_ / "parts").string() + "/"), "");
  EXPECT_EQ(browser_.folder(), folder_ / "parts");
}

TEST_F(FileBrowserTest, WhatIsNotThereIsSaidAndTheNearestFolderShown) {
  browser_.go_to(folder_ / "parts/gone/for good");
  EXPECT_EQ(browser_.folder(), folder_ / "parts");
  EXPECT_THAT(browser_.problem(), HasSubstr("gone/for good: No such file"));
  EXPECT_THAT(names("older"), ElementsAre("older"));
  browser_.go_up();
  EXPECT_EQ(browser_.problem(), "");
  EXPECT_THAT(names("parts"), ElementsAre("parts"));
}

TEST(SizeInWords, HasThreeDigits) {
  EXPECT_EQ(size_in_words(0), "0 B");
  EXPECT_EQ(size_in_words(999), "999 B");
  EXPECT_EQ(size_in_words(3400000), "3.4 MB");
  EXPECT_EQ(size_in_words(52'000'000'000), "52 GB");
}

}  // namespace
}  // namespace nextview
