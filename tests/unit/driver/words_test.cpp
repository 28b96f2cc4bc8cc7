#include "core/driver/words.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <stdexcept>

namespace nextview {
namespace {

using testing::ElementsAre;

TEST(Words, AreSplitAsAShellDoes) {
  EXPECT_THAT(shell_words("scanner"), ElementsAre("scanner"));
  EXPECT_THAT(shell_words("  scanner\t--port 7 \n"), ElementsAre("scanner", "--port", "7"));
  EXPECT_THAT(shell_words("a 'b c' \"d e\" f\\ g"), ElementsAre("a", "b c", "d e", "f g"));
  EXPECT_THAT(shell_words("a'b'\"c\"d"), ElementsAre("abcd"));
  EXPECT_THAT(shell_words("a '' \"\""), ElementsAre("a", "", ""));
  EXPECT_THAT(shell_words(R"(a 'b\' "\"\\\$\n" \')"), ElementsAre("a", "b\\", "\"\\$\\n", "'"));
  EXPECT_THAT(shell_words("a b\\\nc"), ElementsAre("a", "bc"));
}

TEST(Words, NothingIsExpandedAndNoShellRuns) {
  EXPECT_THAT(shell_words("$HOME *.ply ~ `id` | tee > x; y & #z"),
              ElementsAre("$HOME", "*.ply", "~", "`id`", "|", "tee", ">", "x;", "y", "&", "#z"));
}

TEST(Words, WhatDoesNotEndIsAnError) {
  for (const char* bad : {"a 'b", "a \"b", "a \"b\\\"", "a\\", "", "  \t", "'' a"})
    EXPECT_THROW(shell_words(bad), std::invalid_argument) << bad;
}

TEST(Words, NameTheScriptAndNotItsInterpreter) {
  for (const auto& [command, name] : {std::pair{"/usr/bin/python3 drv.py mm", "drv.py"},
                                      {"python3.11 -u a/drv.py --x", "a/drv.py"},
                                      {"/usr/bin/env python3 drv.py", "drv.py"},
                                      {"nextview driver simulated bunny.ply", "nextview"},
                                      {"./drv --fast x", "./drv"},
                                      {"sh -c 'a | b'", "sh"},
                                      {"python3", "python3"}})
    EXPECT_EQ(program_named(shell_words(command)), name) << command;
}

/// What /bin/sh makes of it, a word a line.
std::string split_by_shell(const std::string& text) {
  const std::string command = "printf '%s\\n' " + text;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string lines;
  for (std::array<char, 4096> part; std::fgets(part.data(), part.size(), pipe.get());) lines += part.data();
  return lines;
}

TEST(Words, AreThoseOfTheShellOfThisSystem) {
  for (const std::string text : {"a b  c", "'a b' \"c  d\" e\\ f", "x'y z'\"w\"\\'v", "\"a\\\"b\\\\c\\d\" 'e\\f'"}) {
    std::string lines;
    for (const std::string& word : shell_words(text)) lines += word + "\n";
    EXPECT_EQ(lines, split_by_shell(text)) << text;
  }
}

}  // namespace
}  // namespace nextview
