#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <string_view>

namespace nextview {

inline void write_gzip(const std::filesystem::path& file, std::string_view content) {
  gzFile stream = gzopen(file.c_str(), "wb");
  ASSERT_NE(stream, nullptr) << file;
  EXPECT_EQ(gzwrite(stream, content.data(), static_cast<unsigned>(content.size())), static_cast<int>(content.size()));
  EXPECT_EQ(gzclose(stream), Z_OK);
}

}  // namespace nextview
