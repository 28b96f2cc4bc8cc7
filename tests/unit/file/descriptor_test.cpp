#include "core/file/descriptor.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>

#include <cerrno>
#include <ostream>

#include "core/file/counted.hpp"
#include "core/file/descriptor_buffer.hpp"
#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

int open_null() { return ::open("/dev/null", O_RDWR | O_CLOEXEC); }

bool is_open(int number) { return ::fcntl(number, F_GETFD) != -1; }

TEST(Descriptor, ClosesAtItsEndAndOnce) {
  const int number = open_null();
  ASSERT_GE(number, 0);
  {
    Descriptor descriptor(number);
    EXPECT_TRUE(descriptor.is_open());
    EXPECT_EQ(descriptor.get(), number);
    EXPECT_TRUE(is_open(number));
  }
  EXPECT_FALSE(is_open(number));
  Descriptor closed(open_null());
  closed.close();
  EXPECT_FALSE(closed.is_open());
  const int another = open_null();  // which gets the number that is free again
  closed.close();
  EXPECT_TRUE(is_open(another));
  ::close(another);
}

TEST(Descriptor, OfNothingIsNotOpen) {
  EXPECT_FALSE(Descriptor().is_open());
  EXPECT_FALSE(Descriptor(-1).is_open());
  Descriptor standard_input(0);  // the least that there is
  EXPECT_TRUE(standard_input.is_open());
  EXPECT_EQ(standard_input.release(), 0);
}

TEST(Descriptor, WhatIsReleasedStaysOpen) {
  const int number = open_null();
  {
    Descriptor descriptor(number);
    EXPECT_EQ(descriptor.release(), number);
    EXPECT_FALSE(descriptor.is_open());
  }
  EXPECT_TRUE(is_open(number));
  ::close(number);
}

TEST(Descriptor, MovesWithItsFile) {
  const int first = open_null(), second = open_null();
  Descriptor from(first), to(second);
  to = std::move(from);
  EXPECT_EQ(to.get(), first);
  EXPECT_FALSE(is_open(second)) << "nobody else would close it";
  Descriptor made(std::move(to));
  EXPECT_EQ(made.get(), first);
  EXPECT_TRUE(is_open(first));
}

TEST(DescriptorBuffer, WritesWhatItIsGivenHoweverMuch) {
  const TemporaryFolder folder;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{(1 << 16) - 1}, std::size_t{1 << 16},
                                 std::size_t{(1 << 16) + 1}, std::size_t{300'000}}) {
    std::string text;
    for (std::size_t i = 0; i < size; ++i) text += char('a' + i % 23);
    const auto file = folder / "file";
    const Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
    DescriptorBuffer buffer(descriptor.get());
    std::ostream stream(&buffer);
    stream << text.substr(0, size / 3) << text.substr(size / 3);
    EXPECT_TRUE(stream.good());
    EXPECT_EQ(buffer.flush(), 0);
    EXPECT_EQ(read_file(file) == text, true) << size;
    stream << "more";
    stream.flush();
    EXPECT_EQ(read_file(file) == text + "more", true) << size;
  }
}

TEST(DescriptorBuffer, KeepsWhyAWriteFailed) {
  const Descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  DescriptorBuffer buffer(full.get());
  std::ostream stream(&buffer);
  stream << std::string(100'000, 'x');
  EXPECT_FALSE(stream.good());
  EXPECT_EQ(buffer.flush(), ENOSPC);
  EXPECT_EQ(buffer.flush(), ENOSPC) << "nothing is written any more";
  EXPECT_THAT(file_error("a.ply", "written", ENOSPC).what(),
              testing::StrEq("a.ply: cannot be written: No space left on device"));
  EXPECT_THAT(file_error("a.ply", "written", ENAMETOOLONG).what(),
              testing::StrEq("a.ply: cannot be written: File name too long; give a shorter one"));
}

TEST(Counted, OneIsSingular) {
  EXPECT_EQ(counted(1, "view"), "1 view");
  for (const std::uint64_t many : {0, 2, 11, 21}) EXPECT_EQ(counted(many, "view"), std::to_string(many) + " views");
  EXPECT_EQ(counted(1, "vertex", "vertices"), "1 vertex");
  EXPECT_EQ(counted(0, "vertex", "vertices"), "0 vertices");
  EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
}

}  // namespace
}  // namespace nextview
