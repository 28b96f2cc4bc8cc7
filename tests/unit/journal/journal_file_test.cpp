// Records that outlive whatever ends the program.
#include "core/journal/journal_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using ::testing::ElementsAre;

class JournalFileTest : public testing::Test {
 protected:
  void write_three() const {
    JournalFile journal = JournalFile::begin(file_);
    for (const char* record : {"one", "two", "three"}) journal.append(record);
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "journal";
};

TEST_F(JournalFileTest, HoldsWhatWasAppended) {
  write_three();
  EXPECT_THAT(read_journal_file(file_).records, ElementsAre("one", "two", "three"));
  JournalText text;
  JournalFile::go_on(file_, text).append("four");
  EXPECT_THAT(text.records, ElementsAre("one", "two", "three"));
  EXPECT_THAT(read_journal_file(file_).records, ElementsAre("one", "two", "three", "four"));
}

TEST_F(JournalFileTest, KeepsItsTimeUntilSomethingIsAppended) {
  write_three();
  const auto time = std::filesystem::last_write_time(file_) - std::chrono::hours(1);
  std::filesystem::last_write_time(file_, time);
  JournalText text;
  { JournalFile::go_on(file_, text); }
  EXPECT_EQ(std::filesystem::last_write_time(file_), time);
}

TEST_F(JournalFileTest, CutAnywhereItHoldsTheRecordsThatAreWhole) {
  write_three();
  const std::string whole = read_file(file_);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    write_file(file_, whole.substr(0, size));
    const auto lines = std::size_t(std::count(whole.begin(), whole.begin() + std::ptrdiff_t(size), '\n'));
    JournalText text;
    { JournalFile::go_on(file_, text).append("next"); }
    ASSERT_EQ(text.records.size(), lines) << size;
    ASSERT_TRUE(text.damage.empty()) << "what was being written is no damage";
    ASSERT_EQ(read_journal_file(file_).records.size(), lines + 1) << size;
    ASSERT_EQ(read_journal_file(file_).records.back(), "next");
  }
}

TEST_F(JournalFileTest, AnyByteThatChangedCostsItsRecordAlone) {
  write_three();
  const std::string whole = read_file(file_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = char(changed[at] ^ 0x04);
    write_file(file_, changed);
    const JournalText text = read_journal_file(file_);
    // A line break that is lost takes the record after it, too, and the last one looks as if it was being written.
    const bool is_break = whole[at] == '\n';
    ASSERT_GE(text.records.size(), is_break ? 1u : 2u) << at;
    ASSERT_LE(text.records.size(), 2u) << at;
    for (const std::string& record : text.records) ASSERT_THAT(record, testing::AnyOf("one", "two", "three"));
    ASSERT_EQ(text.damage.empty(), at + 1 == whole.size()) << at;
  }
}

TEST_F(JournalFileTest, IsWrittenByOneAlone) {
  write_three();
  JournalText text;
  const JournalFile first = JournalFile::go_on(file_, text);
  EXPECT_THROW(JournalFile::go_on(file_, text), JournalInUse);
  EXPECT_EQ(read_journal_file(file_).records.size(), 3u) << "others may read it";
}

TEST_F(JournalFileTest, IsNeverBegunTwice) {
  write_three();
  EXPECT_THROW(JournalFile::begin(file_), std::runtime_error);
}

TEST_F(JournalFileTest, OnAFullDiskItStaysAsItWas) {
  EXPECT_THROW(JournalFile::begin("/nowhere/journal"), std::runtime_error);
  EXPECT_THROW(read_journal_file("/dev/zero"), std::runtime_error);
}

}  // namespace
}  // namespace nextview
