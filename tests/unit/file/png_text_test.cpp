// Texts that PNG pictures carry: chunk by chunk, as the format is described.
#include "core/file/png_text.hpp"

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

std::string chunk(const std::string& name, const std::string& content) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(content.size() >> shift & 255);
  return bytes + name + content + "crc.";
}

const std::string begin = "\x89PNG\r\n\x1a\n" + chunk("IHDR", std::string("\0\0\1\2\0\0\0\3\x08\6\0\0\0", 13));
const std::string end = chunk("IEND", "");

TEST(PngText, SizeAndTextsAreFound) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("a.png", begin + chunk("tEXt", std::string("Software\0x", 10)) + chunk("IDAT", "pixels") +
                                chunk("tEXt", std::string("nextview configuration\0seed = 1\n", 32)) + end);
  const PngInfo info = read_png_info(file);
  EXPECT_EQ(info.width, 258u);
  EXPECT_EQ(info.height, 3u);
  ASSERT_EQ(info.texts.size(), 2u);
  EXPECT_EQ(info.texts[0].keyword, "Software");
  EXPECT_EQ(png_configuration(file), "seed = 1\n");
  EXPECT_EQ(png_configuration(folder.write("b.png", begin + end)), "");
}

TEST(PngText, CutOffAtAnyByteItIsSaid) {
  const TemporaryFolder folder;
  const std::string whole = begin + chunk("tEXt", std::string("a\0b", 3)) + end;
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(read_png_info(folder.write("cut.png", whole.substr(0, size))), std::runtime_error) << size;
  EXPECT_NO_THROW(read_png_info(folder.write("cut.png", whole)));
  EXPECT_THROW(read_png_info(folder.write("huge.png", begin + "\xff\xff\xff\xfftEXt")), std::runtime_error);
}

}  // namespace
}  // namespace nextview
