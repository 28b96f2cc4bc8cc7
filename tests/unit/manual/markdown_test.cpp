#include "ui/manual/markdown.hpp"

#include <gmock/gmock.h>

#include <random>

namespace nextview {
namespace {

using Kind = MarkdownBlock::Kind;
using ::testing::ElementsAre;

TEST(Markdown, PartsOfAPageAreWhatTheyAre) {
  const auto blocks = parse_markdown(
      "# The *whole*\n\nOne line\nand `a **b**` another with **two words** and [a link](page.md).\n\n- first\n- "
      "second,\n"
      "  of two lines\n\n12. twelve\n<!-- left\nout -->\n![a picture](a.png)\n\n| a | b |\n|---|---|\n| `c` | |\n"
      "```sh run\nls *.md  # | no table\n```\n");
  std::vector<Kind> kinds;
  for (const MarkdownBlock& block : blocks) kinds.push_back(block.kind);
  ASSERT_THAT(kinds, ElementsAre(Kind::heading, Kind::paragraph, Kind::item, Kind::item, Kind::item, Kind::picture,
                                 Kind::table, Kind::code));
  EXPECT_EQ(blocks[0].text, "The whole");
  EXPECT_EQ(blocks[0].level, 1);
  EXPECT_EQ(blocks[1].text, "One line and a **b** another with two words and a link.");
  EXPECT_EQ(blocks[3].text, "second, of two lines");
  EXPECT_EQ(blocks[4].number, "12.");
  EXPECT_EQ(blocks[5].text, "a picture");
  EXPECT_THAT(blocks[6].rows, ElementsAre(ElementsAre("a", "b"), ElementsAre("c", "")));
  EXPECT_EQ(blocks[7].text, "ls *.md  # | no table\n");
  EXPECT_EQ(blocks[7].language, "sh run");
}

TEST(Markdown, PlainTextKeepsToItsWidth) {
  const std::string page =
      "# A µ title\n\nSome words that need more than one line here\n\n1. an item of quite a few words, too\n2. b\n\n"
      "| key | is |\n|---|---|\n| a | short |\n\n| key | is |\n|---|---|\n| b | far too long for a column beside it "
      "|\n";
  EXPECT_EQ(plain_text(parse_markdown(page), 24),
            "A µ title\n=========\n\nSome words that need\nmore than one line here\n\n1. an item of quite a\n   few "
            "words, too\n"
            "2. b\n\nkey  is\n-------\na    short\n\nb\n    is: far too long for\n    a column beside it\n");
}

TEST(Markdown, AnyTextIsRead) {
  std::mt19937 random(20240229 + unsigned(testing::GTEST_FLAG(random_seed)));
  const std::vector<std::string> parts = {"|",  "```", "# ", "\n", "- ", "1. ", "<!--", "-->",
                                          "![", "](",  ")",  "*",  "`",  "a",   " "};
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (unsigned n = random() % 40; n-- > 0;) text += parts[random() % parts.size()];
    SCOPED_TRACE(text);
    EXPECT_NO_THROW(plain_text(parse_markdown(text), 1 + random() % 60));
  }
}

}  // namespace
}  // namespace nextview
