#include "core/file/gzip_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

/// Why zlib stopped, in words; empty if all is well.
std::string failure(gzFile stream) {
  int error = Z_OK;
  gzerror(stream, &error);
  if (error == Z_OK || error == Z_STREAM_END) return "";
  if (error == Z_BUF_ERROR) return "it is truncated";
  if (error == Z_DATA_ERROR) return "its compressed data are damaged";
  if (error == Z_ERRNO) return std::strerror(errno);
  return zError(error);
}

}  // namespace

std::string read_gzip_file(const std::filesystem::path& file, std::uintmax_t largest) {
  const auto cannot = [&](const std::string& why) {
    return std::runtime_error(fmt::format("{}: cannot be read: {}", file.string(), why));
  };
  Descriptor descriptor = open_regular_file(file);
  const std::unique_ptr<gzFile_s, decltype(&gzclose_r)> stream(gzdopen(descriptor.get(), "rb"), gzclose_r);
  if (!stream) throw cannot("out of memory");
  descriptor.release();  // the stream closes it
  std::string content;
  std::vector<char> part(1 << 17);
  for (int got; (got = gzread(stream.get(), part.data(), static_cast<unsigned>(part.size()))) > 0;) {
    if (static_cast<std::uintmax_t>(got) > largest - content.size())
      throw cannot(fmt::format("it holds more than {} bytes, decompressed", largest));
    content.append(part.data(), static_cast<std::size_t>(got));
  }
  // A file that is cut off ends like a whole one; only the error that is then set tells.
  if (const std::string why = failure(stream.get()); !why.empty()) throw cannot(why);
  if (gzdirect(stream.get())) throw cannot("it is not compressed with gzip");  // zlib passes other bytes through
  return content;
}

std::string read_plain_or_gzip(const std::filesystem::path& file, std::uintmax_t largest) {
  return file.extension() == ".gz" ? read_gzip_file(file, largest) : read_file(file, largest);
}

std::filesystem::path without_gz(const std::filesystem::path& file) {
  return file.extension() == ".gz" ? file.parent_path() / file.stem() : file;
}

}  // namespace nextview
