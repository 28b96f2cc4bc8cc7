#include "core/file/make_folder.hpp"

#include <gmock/gmock.h>

#include "core/file/atomic_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

std::string reason_against(const fs::path& folder) {
  try {
    make_folder(folder);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(MakeFolder, MakesThoseThatItLiesInAndLeavesWhatIsThere) {
  const TemporaryFolder temporary;
  make_folder(temporary / "a/b");
  write_file(temporary / "a/b/file", "text");
  make_folder(temporary / "a/b");
  EXPECT_EQ(read_file(temporary / "a/b/file"), "text");
}

TEST(MakeFolder, TellsWhyItCannot) {
  const TemporaryFolder temporary;
  const fs::path file = temporary / "file", in_it = file / "folder", long_name = temporary / std::string(300, 'a');
  write_file(file, "text");
  EXPECT_EQ(reason_against(file), file.string() + ": cannot be made a folder: there is a file of this name");
  EXPECT_EQ(reason_against(in_it), in_it.string() + ": cannot be made a folder: Not a directory");
  EXPECT_EQ(reason_against(long_name),
            long_name.string() + ": cannot be made a folder: File name too long; give a shorter one");
  EXPECT_EQ(read_file(file), "text");
}

}  // namespace
}  // namespace nextview
