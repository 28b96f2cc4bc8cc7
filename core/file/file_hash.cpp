#include "core/file/file_hash.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <vector>

#include "core/file/read_file.hpp"

namespace nextview {

void HashOfParts::add(std::string_view bytes) {
  crc_ =
      static_cast<std::uint32_t>(::crc32_z(crc_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  bytes_ += bytes.size();
}

FileHash HashOfParts::hash() const { return {bytes_, fmt::format("{:08x}", crc_)}; }

FileHash file_hash(const std::filesystem::path& file) {
  const Descriptor descriptor = open_regular_file(file);
  HashOfParts hash;
  std::vector<char> part(1 << 20);
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw file_error(file, "read", errno);
    if (got == 0) return hash.hash();
    hash.add({part.data(), static_cast<std::size_t>(got)});
  }
}

FileHash hash_of(std::string_view bytes) {
  HashOfParts hash;
  hash.add(bytes);
  return hash.hash();
}

}  // namespace nextview
