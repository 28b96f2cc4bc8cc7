#include "core/setting/mistyped_path.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

TEST(MistypedPath, IsTakenForWhatIsBesideIt) {
  const TemporaryFolder folder;
  for (const char* name : {"first scan", "other", "out-2"}) std::filesystem::create_directory(folder.path() / name);
  const auto hint = [](const std::filesystem::path& meant) { return "; did you mean '" + meant.string() + "'?"; };
  EXPECT_EQ(did_you_mean_path(folder.path() / "frist scan"), hint(folder.path() / "first scan"));
  EXPECT_EQ(did_you_mean_path(folder.path() / "ohter/"), hint(folder.path() / "other"));
  EXPECT_EQ(did_you_mean_path(folder.path() / "mine", {"mine"}, "; see there"), "; see there")
      << "what is known has no folder";
  EXPECT_EQ(did_you_mean_path("mien", {"mine"}), hint("mine"));
  EXPECT_EQ(did_you_mean_path(folder.path() / "none/out"), "") << "the folder is not there either";
  const auto is_no_copy = [](const std::filesystem::path& path) { return path.filename() != "out-2"; };
  EXPECT_EQ(did_you_mean_path(folder.path() / "out", {}, "", is_no_copy), "");
  EXPECT_EQ(did_you_mean_path(folder.path() / "out"), hint(folder.path() / "out-2"));
}

}  // namespace
}  // namespace nextview
