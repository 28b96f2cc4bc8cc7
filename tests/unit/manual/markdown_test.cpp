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
  ASSERT_EQ(blocks[1].links.size(), 1u);
  EXPECT_EQ(blocks[1].links[0].target, "page.md");
  EXPECT_EQ(blocks[1].text.substr(blocks[1].links[0].begin), "a link.");
  EXPECT_EQ(blocks[5].picture, "a.png");
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

TEST(Markdown, ATablesCellsNeedNoSpacesAndNoBarAtTheEnd) {
  const auto rows = [](const char* text) {
    const auto blocks = parse_markdown(text);
    return blocks.size() == 1 ? blocks[0].rows : std::vector<std::vector<std::string>>();
  };
  const std::vector<std::vector<std::string>> expected = {{"ab", "cd"}, {"1", "23"}};
  EXPECT_EQ(rows("|ab|cd|\n|--|:-:|\n|1|23|\n"), expected);
  EXPECT_EQ(rows("  | ab | cd |  \n| --- | --- |\n|  1  |  23 |\n"), expected);
  EXPECT_EQ(rows("|ab|cd\n|---|---\n|1|23\n"), expected);
  EXPECT_THAT(rows("|a|b|c|\n|1|\n|1|2|3|4|\n"),
              ElementsAre(ElementsAre("a", "b", "c"), ElementsAre("1", "", ""), ElementsAre("1", "2", "3")))
      << "all rows are as long as the heads";
  EXPECT_THAT(rows("|a|b|\n|-|-|\n|P(x \\| y)|`--of map\\|cloud`|\n"),
              ElementsAre(ElementsAre("a", "b"), ElementsAre("P(x | y)", "--of map|cloud")));
}

TEST(Markdown, WhatBeginsLikeSomethingElseIsText) {
  for (const char* text : {"-1 is a number", "1.5 mm", "a - b", "12 and more.", "- "}) {
    const auto blocks = parse_markdown(text);
    ASSERT_EQ(blocks.size(), 1u) << text;
    EXPECT_EQ(blocks[0].kind, Kind::paragraph) << text;
  }
  EXPECT_TRUE(parse_markdown("###\n<br>\n<!-- left out -->\n").empty());
  const auto blocks = parse_markdown("### Deep\na<br>\n<br>\nb\n<!-- out --> of\nc\n- d\n| e |\nf\n");
  std::vector<std::pair<Kind, std::string>> all;
  for (const MarkdownBlock& block : blocks) all.emplace_back(block.kind, block.text);
  EXPECT_THAT(all,
              ElementsAre(std::pair(Kind::heading, "Deep"), std::pair(Kind::paragraph, "a<br>"),
                          std::pair(Kind::paragraph, "b"), std::pair(Kind::paragraph, "c"), std::pair(Kind::item, "d"),
                          std::pair(Kind::table, ""), std::pair(Kind::paragraph, "f")));
  EXPECT_EQ(blocks[0].level, 3);
}

TEST(Markdown, NumberedItemsKeepTheirNumbersAndOthersHaveNone) {
  const auto blocks = parse_markdown("- a\n1. b\n- c\n- d\n");
  std::vector<std::string> numbers;
  for (const MarkdownBlock& block : blocks) numbers.push_back(block.number);
  EXPECT_THAT(numbers, ElementsAre("", "1.", "", ""));
}

TEST(Markdown, CodeIsIndentedLineByLine) {
  const auto text = [](const char* page) { return plain_text(parse_markdown(page), 12); };
  EXPECT_EQ(text("```sh\nls *.md\n```\n"), "    ls *.md\n");
  EXPECT_EQ(text("```\n  a  line that is wider\n\n-b-\n```\n"), "      a  line that is wider\n    \n    -b-\n");
  EXPECT_EQ(text("```\n```\n"), "");
  EXPECT_EQ(text("a\n```\nb\n```\nc\n"), "a\n\n    b\n\nc\n");
}

TEST(Markdown, LinesAreBrokenWhereTheNextWordWouldBeBeyond) {
  const auto text = [](const char* page, std::size_t width) { return plain_text(parse_markdown(page), width); };
  EXPECT_EQ(text("four five six", 13), "four five six\n");
  EXPECT_EQ(text("four five six", 12), "four five\nsix\n");
  EXPECT_EQ(text("four five six", 9), "four five\nsix\n");
  EXPECT_EQ(text("four five six", 8), "four\nfive six\n");
  EXPECT_EQ(text("größe µ", 7), "größe µ\n") << "characters count, not bytes";
  EXPECT_EQ(text("an incomprehensible one", 6), "an\nincomprehensible\none\n") << "a word is not broken";
  EXPECT_EQ(text("- one two\n- three\n\n![a picture](a.png)", 7), "- one\n  two\n- three\n\n(picture:\na\npicture)\n");
}

TEST(Markdown, ATableStandsColumnUnderColumnOnlyWhereItFits) {
  const std::string page = "| key | is |\n|---|---|\n| a | short words |\n| bc | |\n";
  const auto blocks = parse_markdown(page);
  EXPECT_EQ(plain_text(blocks, 20), "key  is\n-------\na    short words\nbc\n");
  EXPECT_EQ(plain_text(blocks, 14), "a\n    is: short\n    words\nbc\n");
}

TEST(Markdown, ATableOfPicturesIsAListOfWhatTheyAreCalledAndShow) {
  const auto blocks = parse_markdown(
      "before\n| | |\n|---|---|\n| ![a cube](a.png) *Cube* | ![](b.png) a ball |\n| ![a cone](c.png) | |\nafter\n");
  EXPECT_EQ(plain_text(blocks, 60), "before\n\n- Cube: a cube\n- a ball\n- a cone\n\nafter\n");
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
