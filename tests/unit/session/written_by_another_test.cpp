// A session that another program has written since it was read is not gone on with.
#include <gtest/gtest.h>

#include "core/session/session_folder.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

class WrittenByAnother : public testing::Test {
 protected:
  WrittenByAnother() {
    Session session(small_scan());
    SessionFolder folder = SessionFolder::begin(OutputFolder(path(), {}), session);
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(folder.step(session));
  }
  std::filesystem::path path() const { return folder_ / "session"; }
  /// Whether one can go on from what was read before.
  bool goes_on(const SavedSession& saved) const {
    const Session session(saved.configuration);
    try {
      SessionFolder::go_on(OutputFolder(path(), {}), saved, session);
      return true;
    } catch (const JournalInUse& error) {
      EXPECT_EQ(error.what(), path().string() + ": another program has written this session");
      return false;
    }
  }
  TemporaryFolder folder_;
};

TEST_F(WrittenByAnother, AsItWasItGoesOn) {
  const SavedSession saved = read_session(path());
  EXPECT_TRUE(goes_on(saved));
  EXPECT_TRUE(goes_on(saved)) << "to look at it changes nothing";
}

TEST_F(WrittenByAnother, StandingElsewhereItDoesNot) {
  const SavedSession saved = read_session(path());
  Journal journal;
  JournalWriter::go_on(path(), journal).stand_at(1);
  EXPECT_FALSE(goes_on(saved));
  JournalWriter::go_on(path(), journal).stand_at(2);
  EXPECT_TRUE(goes_on(saved)) << "it stands where it stood";
}

TEST_F(WrittenByAnother, WithAViewMoreItDoesNotWhereverItStands) {
  const SavedSession saved = read_session(path());
  {
    Session another(saved.configuration);
    SavedSession its = saved;
    SessionFolder folder = SessionFolder::go_on(OutputFolder(path(), {}), its, another);
    ASSERT_TRUE(restore(another, its, &folder));
    ASSERT_TRUE(folder.step(another));
  }
  EXPECT_FALSE(goes_on(saved));
  Journal journal;
  JournalWriter::go_on(path(), journal).stand_at(2);
  EXPECT_FALSE(goes_on(saved)) << "its next view would be the third again";
}

}  // namespace
}  // namespace nextview
