#include "core/file/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace nextview {
namespace {

std::runtime_error cannot(const char* what, const std::filesystem::path& file, int error) {
  return std::runtime_error(
      fmt::format("{}: cannot be {}: {}", file.string(), what, error ? std::strerror(error) : "unknown reason"));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)) {
  temporary_ = file_;
  temporary_ += fmt::format(".{}-{}.part", ::getpid(), fmt::ptr(this));  // no two writers share one
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw cannot("written", file_, errno);
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) throw cannot("written", file_, errno);
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) throw cannot("written", file_, error.value());
  temporary_.clear();
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  AtomicFile out(file);
  out.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  out.commit();
}

std::string read_file(const std::filesystem::path& file, std::uintmax_t largest) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw cannot("read", file, ENOENT);
  if (std::filesystem::is_directory(status)) throw cannot("read", file, EISDIR);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw cannot("read", file, errno);
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > largest)
    throw std::runtime_error(fmt::format("{}: has {} bytes; at most {} are read", file.string(), size, largest));
  std::string content;
  content.reserve(error ? 0 : size);
  std::vector<char> part(1 << 16);  // pipes and devices do not tell their size
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0) {
    content.append(part.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > largest)
      throw std::runtime_error(
          fmt::format("{}: has more than the {} bytes that are read at most", file.string(), largest));
  }
  if (in.bad()) throw cannot("read", file, errno);
  return content;
}

}  // namespace nextview
