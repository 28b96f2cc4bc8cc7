#include "tests/render/failures_page.hpp"

#include <gmock/gmock.h>

#include <regex>

#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(FailuresPage, HasAllThatDiffersNowSideBySide) {
  const TemporaryFolder folder;
  const FailuresPage page(folder.path() / "failures");
  const Image grey{2, 1, std::vector<std::uint8_t>(8, 128)}, white{2, 1, std::vector<std::uint8_t>(8, 255)};
  page.add("one", &grey, white, grey, "50 % differ & more than 3 < 4");
  page.add("two", nullptr, white, {}, "is missing");
  const std::string text = read_file(page.file());
  EXPECT_THAT(text, HasSubstr("2 pictures differ"));
  EXPECT_THAT(text, HasSubstr("50 % differ &amp; more than 3 &lt; 4"));
  EXPECT_THAT(text, HasSubstr("<td>none</td>")) << "there is no stored one";
  static const std::regex source("src=\"([^\"]+)\"");
  int pictures = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), source), end; found != end; ++found, ++pictures)
    EXPECT_TRUE(std::filesystem::exists(page.file().parent_path() / (*found)[1].str())) << (*found)[1];
  EXPECT_EQ(pictures, 4);
  page.remove("one");
  EXPECT_THAT(read_file(page.file()), HasSubstr("1 pictures differ"));
  EXPECT_THAT(read_file(page.file()), Not(HasSubstr("one.actual.png")));
  page.remove("never there");
}

TEST(FailuresPage, IsNotMadeWithoutNeed) {
  const TemporaryFolder folder;
  const FailuresPage page(folder.path() / "failures");
  page.remove("one");
  EXPECT_FALSE(std::filesystem::exists(page.file()));
}

}  // namespace
}  // namespace nextview
