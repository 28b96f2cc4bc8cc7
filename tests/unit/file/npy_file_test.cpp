#include "core/file/npy_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

/// A file with this header, as NumPy writes version 1, and so many bytes of values.
std::string npy(std::string header, std::size_t bytes, char version = 1) {
  header += '\n';
  std::string text = std::string("\x93NUMPY") + version + '\0' + char(header.size()) + '\0';
  if (version > 1) text += std::string(2, '\0');
  return text + header + std::string(bytes, '\0');
}

std::string reason(const std::filesystem::path& file) {
  try {
    read_npy(file);
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string()));
    return error.what();
  }
  return "it was read";
}

TEST(NpyFile, ComesBackToTheBit) {
  const TemporaryFolder folder;
  NpyTable table{3, 2, {1.5f, std::numeric_limits<float>::infinity(), std::nanf("7"), 0.1f, 1e-40f, 3.0f}};
  write_npy(table, folder / "a.npy");
  const NpyTable read = read_npy(folder / "a.npy");
  EXPECT_EQ(read.columns, 3);
  EXPECT_EQ(read.rows, 2);
  ASSERT_EQ(read.values.size(), 6u);
  EXPECT_EQ(std::memcmp(read.values.data(), table.values.data(), 6 * sizeof(float)), 0);
  const std::string bytes = read_file(folder / "a.npy");
  EXPECT_EQ((bytes.size() - 24) % 64, 0u) << "NumPy aligns values";
}

TEST(NpyFile, OfAllVersionsIsRead) {
  const TemporaryFolder folder;
  const std::string header = "{\"descr\": \"<f4\", 'shape': (2, 3,), 'fortran_order': False}";
  for (const char version : {1, 2, 3})
    EXPECT_EQ(read_npy(folder.write("a.npy", npy(header, 24, version))).rows, 2) << int(version);
}

TEST(NpyFile, DoublesAreReadToo) {
  const TemporaryFolder folder;
  std::string bytes = npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }", 16);
  const double values[] = {0.1, std::numeric_limits<double>::infinity()};
  std::memcpy(bytes.data() + bytes.size() - 16, values, 16);
  EXPECT_EQ(read_npy(folder.write("a.npy", bytes)).values,
            (std::vector<float>{0.1f, std::numeric_limits<float>::infinity()}));
}

TEST(NpyFile, WhatIsNotReadIsSaid) {
  const TemporaryFolder folder;
  const auto header = [](const char* type, const char* order, const char* shape) {
    return std::string("{'descr': '") + type + "', 'fortran_order': " + order + ", 'shape': (" + shape + "), }";
  };
  const auto of = [&](const std::string& bytes) { return reason(folder.write("a.npy", bytes)); };
  EXPECT_THAT(of(npy(header("<i8", "False", "2, 3"), 48)), HasSubstr("'<i8'"));
  EXPECT_THAT(of(npy(header(">f4", "False", "2, 3"), 24)), HasSubstr("'>f4'"));
  EXPECT_THAT(of(npy(header("<f4", "True", "2, 3"), 24)), HasSubstr("C order"));
  EXPECT_THAT(of(npy(header("<f4", "False", "6,"), 24)), HasSubstr("two dimensions"));
  EXPECT_THAT(of(npy(header("<f4", "False", "2, 3, 1"), 24)), HasSubstr("two dimensions"));
  for (const char* shape : {"99999999999, 3", "1234567, 3", "-2, 3", "2 3", "2, 3,,", "2, ", "", "2,\t3"})
    EXPECT_THAT(of(npy(header("<f4", "False", shape), 24)), HasSubstr("two dimensions")) << shape;
  EXPECT_THAT(of(npy(header("<f4", "False", "999999, 999999"), 24)), HasSubstr("bytes of values"));
  EXPECT_THAT(of(npy(header("<f4", "False", "2, 3"), 23)), HasSubstr("bytes of values"));
  EXPECT_THAT(of(npy(header("<f4", "False", "2, 3"), 25)), HasSubstr("bytes of values"));
  EXPECT_THAT(of(npy("", 0)), HasSubstr("type"));
  const std::string before = std::string("\x93NUMPY\1\0", 8), text = header("<f4", "False", "2, 3");
  const auto padded = [&](std::size_t size) {  // a header of so many bytes, below 2^16
    return before + char(size % 256) + char(size / 256) + text + std::string(size - text.size(), ' ') +
           std::string(24, '\0');
  };
  EXPECT_EQ(of(padded(4096)), "it was read");
  EXPECT_THAT(of(padded(4097)), HasSubstr("type")) << "nobody writes so long a header";
  EXPECT_THAT(of(npy(header("<f4", "False", "2, 3"), 24, 9)), HasSubstr("version 9"));
  EXPECT_THAT(of("ply\n"), HasSubstr("no .npy file"));
  EXPECT_THAT(of(""), HasSubstr("no .npy file"));
  const std::string whole = npy(header("<f4", "False", "2, 3"), 24);
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(of(whole.substr(0, size)), "it was read") << size;
  EXPECT_THAT(reason(folder / "none.npy"), HasSubstr("none.npy"));
  EXPECT_THAT(reason(folder / "."), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace nextview
