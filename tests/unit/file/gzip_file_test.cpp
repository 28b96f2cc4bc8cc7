#include "core/file/gzip_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "core/file/atomic_file.hpp"
#include "tests/unit/file/gzip.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

std::string every_byte(std::size_t size) {
  std::string bytes;
  for (std::size_t n = 0; n < size; ++n) bytes += static_cast<char>(n * 7 + n / 256);
  return bytes;
}

/// The one line that reading fails with; it begins with the file's name.
std::string complaint(const std::filesystem::path& file, std::uintmax_t largest = 1 << 20) {
  try {
    read_gzip_file(file, largest);
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(file.string() + ": cannot be read: "));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no complaint";
}

TEST(GzipFile, GivesBackWhatWasCompressed) {
  const TemporaryFolder folder;
  constexpr std::size_t part = 1 << 17;  // is read at a time
  for (const std::size_t size : {std::size_t(0), std::size_t(1), part - 1, part, part + 1, 3 * part}) {
    write_gzip(folder / "a.gz", every_byte(size));
    EXPECT_EQ(read_gzip_file(folder / "a.gz"), every_byte(size)) << size;
  }
}

TEST(GzipFile, GivesAllMembersOfAFile) {
  const TemporaryFolder folder;
  write_gzip(folder / "a.gz", "one ");
  write_gzip(folder / "b.gz", "two");
  folder.write("both.gz", read_file(folder / "a.gz") + read_file(folder / "b.gz"));
  EXPECT_EQ(read_gzip_file(folder / "both.gz"), "one two");
}

TEST(GzipFile, IsRefusedWhereverItIsCutOff) {
  const TemporaryFolder folder;
  write_gzip(folder / "a.gz", every_byte(300));
  const std::string whole = read_file(folder / "a.gz");
  ASSERT_GT(whole.size(), 100u);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THAT(complaint(folder.write("cut.gz", whole.substr(0, size))),
                HasSubstr(size < 2 ? "not compressed" : "truncated"))
        << size;
}

TEST(GzipFile, IsRefusedIfItIsDamaged) {
  const TemporaryFolder folder;
  write_gzip(folder / "a.gz", every_byte(2000));
  std::string damaged = read_file(folder / "a.gz");
  damaged[damaged.size() - 6] ^= 1;  // within the check sum
  EXPECT_THAT(complaint(folder.write("sum.gz", damaged)), HasSubstr("damaged"));
  damaged = read_file(folder / "a.gz");
  for (std::size_t i = 10; i < 40; ++i) damaged[i] = static_cast<char>(0xff);
  EXPECT_THAT(complaint(folder.write("data.gz", damaged)), HasSubstr("damaged"));
}

TEST(GzipFile, IsRefusedIfItHoldsTooMuch) {
  const TemporaryFolder folder;
  write_gzip(folder / "a.gz", std::string(1 << 20, '\0'));
  ASSERT_LT(std::filesystem::file_size(folder / "a.gz"), 2000u) << "a bomb is small";
  EXPECT_EQ(read_gzip_file(folder / "a.gz", 1 << 20).size(), std::size_t(1) << 20);
  EXPECT_THAT(complaint(folder / "a.gz", (1 << 20) - 1), HasSubstr("more than 1048575 bytes"));
}

TEST(GzipFile, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder / "missing.gz"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "folder.gz");
  EXPECT_THAT(complaint(folder / "folder.gz"), HasSubstr("directory"));
  ASSERT_EQ(mkfifo((folder / "pipe.gz").c_str(), 0600), 0);
  EXPECT_THAT(complaint(folder / "pipe.gz"), HasSubstr("is a pipe"));
  EXPECT_THAT(complaint(folder.write("plain.gz", "ply\nformat ascii 1.0\n")), HasSubstr("not compressed with gzip"));
}

}  // namespace
}  // namespace nextview
