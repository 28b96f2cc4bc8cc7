#include "core/file/file_hash.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <vector>

#include "core/file/read_file.hpp"

namespace nextview {

FileHash file_hash(const std::filesystem::path& file) {
  const Descriptor descriptor = open_regular_file(file);
  FileHash hash;
  uLong crc = ::crc32(0, nullptr, 0);
  std::vector<unsigned char> part(1 << 20);
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw file_error(file, "read", errno);
    if (got == 0) break;
    crc = ::crc32(crc, part.data(), static_cast<uInt>(got));
    hash.bytes += static_cast<std::uintmax_t>(got);
  }
  hash.crc32 = fmt::format("{:08x}", crc);
  return hash;
}

FileHash hash_of(std::string_view bytes) {
  const uLong crc =
      ::crc32_z(::crc32(0, nullptr, 0), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return {bytes.size(), fmt::format("{:08x}", crc)};
}

}  // namespace nextview
