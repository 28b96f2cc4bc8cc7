#include "core/file/file_hash.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace nextview {

FileHash file_hash(const std::filesystem::path& file) {
  const auto failure = [&](int error) {
    return std::runtime_error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(error ? error : EIO)));
  };
  if (!std::filesystem::is_regular_file(file)) throw failure(std::filesystem::exists(file) ? EINVAL : ENOENT);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw failure(errno);
  FileHash hash;
  uLong crc = ::crc32(0, nullptr, 0);
  std::vector<char> part(1 << 20);
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0) {
    crc = ::crc32(crc, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(in.gcount()));
    hash.bytes += static_cast<std::uintmax_t>(in.gcount());
  }
  if (in.bad()) throw failure(errno);
  hash.crc32 = fmt::format("{:08x}", crc);
  return hash;
}

}  // namespace nextview
