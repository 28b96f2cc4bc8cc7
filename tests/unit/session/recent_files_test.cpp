#include "core/session/recent_files.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(RecentFiles, AreTheNewestFirstAndOnceEach) {
  const TemporaryFolder folder;
  const std::filesystem::path state = folder / "state";
  for (const char* name : {"a", "b", "c"}) std::ofstream(folder / name) << name;
  EXPECT_THAT(recent_files(state), IsEmpty());
  for (const char* name : {"a", "b", "a", "c"}) add_recent_file(state, folder / name);
  EXPECT_THAT(recent_files(state), ElementsAre(folder / "c", folder / "a", folder / "b"));
  std::filesystem::remove(folder / "a");
  EXPECT_THAT(recent_files(state), ElementsAre(folder / "c", folder / "b")) << "what is gone is not offered";
}

TEST(RecentFiles, ThereAreNoMoreThanTwelve) {
  const TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    std::ofstream(folder / std::to_string(i)) << i;
    add_recent_file(folder / "state", folder / std::to_string(i));
  }
  EXPECT_EQ(recent_files(folder / "state").size(), 12u);
  EXPECT_EQ(recent_files(folder / "state").front(), folder / "19");
}

TEST(RecentFiles, WhereNothingCanBeKeptNothingHappens) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "no folder";
  add_recent_file(folder / "file/state", folder / "file");
  add_recent_file("", folder / "file");
  std::ofstream(folder / "recent") << "not a path\n\n/\n" << std::string(100000, 'x') << "\n";
  EXPECT_THAT(recent_files(folder / ""), ElementsAre("/"));
}

}  // namespace
}  // namespace nextview
