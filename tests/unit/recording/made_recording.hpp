#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/view/pose.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

/// Files of recordings, written without the code that reads them.
namespace nextview::made_recording {

inline std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift);
  return text;
}

inline std::string png_chunk(const std::string& kind, const std::string& content) {
  const std::string body = kind + content;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(content.size()), 4) + body +
         big_endian(static_cast<std::uint32_t>(sum), 4);
}

/// A PNG of rows as they stand: of bytes, each with its filter in front.
inline std::string png(int width, int height, int bits, int kind, const std::string& rows) {
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size());
  packed.resize(size);
  const std::string header = big_endian(static_cast<std::uint32_t>(width), 4) +
                             big_endian(static_cast<std::uint32_t>(height), 4) + static_cast<char>(bits) +
                             static_cast<char>(kind) + std::string(3, '\0');
  const std::size_t half = packed.size() / 2;  // two chunks: readers must join them
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", packed.substr(0, half)) +
         png_chunk("IDAT", packed.substr(half)) + png_chunk("IEND", "");
}

/// 16-bit grey, unfiltered.
inline std::string depth_png(int width, int height, const std::vector<std::uint16_t>& values) {
  std::string rows;
  for (int v = 0; v < height; ++v) {
    rows += '\0';
    for (int u = 0; u < width; ++u) rows += big_endian(values[static_cast<std::size_t>(v * width + u)], 2);
  }
  return png(width, height, 16, 0, rows);
}

inline std::string pgm(int width, int height, const std::vector<std::uint16_t>& values) {
  std::string bytes = "P5\n# made\n" + std::to_string(width) + " " + std::to_string(height) + "\n65535\n";
  for (const std::uint16_t value : values) bytes += big_endian(value, 2);
  return bytes;
}

template <class Value>
std::string raw(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

inline std::string npy(int rows, int columns, const std::string& type, const std::string& data) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                       std::to_string(columns) + "), }";
  header.resize(118, ' ');
  std::string bytes = "\x93NUMPY";
  bytes += std::string("\x01\x00\x76\x00", 4);  // version 1.0; 118 bytes
  return bytes + header + data;
}

/// Four rows.
inline std::string matrix(const Pose& pose) {
  std::string text;
  for (int i = 0; i < 16; ++i) text += fmt::format("{:.17g}{}", pose.matrix()(i / 4, i % 4), i % 4 == 3 ? "\n" : " ");
  return text;
}

/// What `read` throws, to be one line that names the file. Empty if it throws nothing.
template <class Read>
std::string failure_of(Read read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// Reads `bytes` with 500 seeded changes, of which nothing but an exception may come.
template <class Read>
void survives_damage(const TemporaryFolder& folder, const std::string& name, const std::string& bytes, Read read) {
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string damaged = bytes;
    const bool early = i % 2 == 0;  // headers are a small part of most files
    const auto place = [&] { return random() % (early ? std::min<std::size_t>(damaged.size(), 200) : damaged.size()); };
    for (int k = 0; k < 1 + i % 3; ++k) damaged[place()] = static_cast<char>(random());
    if (i % 5 == 0) damaged.resize(place());
    const std::filesystem::path file = folder.write(name, damaged);
    const std::string why = failure_of([&] { read(file); });
    refused += !why.empty();
    EXPECT_TRUE(why.empty() || why.find(name) != std::string::npos) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  }
  EXPECT_GT(refused, 50);
}

}  // namespace nextview::made_recording
