#include "core/file/printable.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

using namespace std::string_literals;

TEST(Printable, LeavesWhatPeopleWrite) {
  for (const char* text :
       {"", "part 1.ply", "C:\\parts\\a.stl", "Gehäuse_Größe.stl", "部品.ply", "деталь", "🐇.obj", "e\u0301"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, WritesOutWhatWouldAct) {
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("\x1b[31mred\x1b]0;title\a"), "\\x1b[31mred\\x1b]0;title\\x07");
  EXPECT_EQ(printable("a\0b\x7f"s), "a\\x00b\\x7f");
  EXPECT_EQ(printable("\u009b31m"), "\\u009b31m") << "a terminal takes this letter for the beginning of a sequence";
  EXPECT_EQ(printable("gnp.\u202eexe"), "gnp.\\u202eexe");
  EXPECT_EQ(printable("a\u2028b\u2069"), "a\\u2028b\\u2069");
}

TEST(Printable, WritesOutBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("a\xc3"), "a\\xc3");                           // cut off
  EXPECT_EQ(printable("\xc3(\xa0"), "\\xc3(\\xa0");                  // no second byte; a second byte alone
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a");                    // a line break in two bytes
  EXPECT_EQ(printable("\xe0\x80\x8a"), "\\xe0\\x80\\x8a");           // in three
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half a pair of UTF-16
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond the last letter
}

}  // namespace
}  // namespace nextview
