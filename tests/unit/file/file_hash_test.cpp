#include "core/file/file_hash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/file/atomic_file.hpp"
#include "tests/unit/map/temporary_folder.hpp"

namespace nextview {
namespace {

using FileHashes = TemporaryFolder;

// The check value that every description of CRC-32 gives.
TEST_F(FileHashes, AreTheCrcOfAllBytes) {
  write_file(folder_ / "a", "123456789");
  EXPECT_EQ(file_hash(folder_ / "a"), (FileHash{9, "cbf43926"}));
  write_file(folder_ / "empty", "");
  EXPECT_EQ(file_hash(folder_ / "empty"), (FileHash{0, "00000000"}));
}

TEST_F(FileHashes, TellOneByteOfALargeFile) {
  std::string bytes((std::size_t{1} << 21) + 3, 'x');
  write_file(folder_ / "a", bytes);
  bytes.back() = 'y';
  write_file(folder_ / "b", bytes);
  EXPECT_EQ(file_hash(folder_ / "a").bytes, bytes.size());
  EXPECT_NE(file_hash(folder_ / "a"), file_hash(folder_ / "b"));
}

TEST_F(FileHashes, OfWhatIsNoFileIsARefusalThatNamesIt) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const char* name : {"missing", "pipe", "."}) {
    try {
      file_hash(folder_ / name);
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith((folder_ / name).string() + ": cannot be read: ")) << name;
    }
  }
}

}  // namespace
}  // namespace nextview
