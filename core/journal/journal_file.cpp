#include "core/journal/journal_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "core/file/file_hash.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;  // [bytes]
constexpr std::size_t checksum_length = 8;

/// The record in a line; empty if it is not whole.
std::string_view record_in(std::string_view line) {
  if (line.size() < checksum_length + 2 || line[checksum_length] != ' ') return {};
  const std::string_view record = line.substr(checksum_length + 1);
  return hash_of(record).crc32 == line.substr(0, checksum_length) ? record : std::string_view();
}

JournalText text_of(std::string_view bytes) {
  JournalText text;
  for (std::size_t at = 0, number = 1; at < bytes.size(); ++number) {
    const std::size_t end = bytes.find('\n', at);
    if (end == bytes.npos) break;  // what was being written
    if (const std::string_view record = record_in(bytes.substr(at, end - at)); !record.empty())
      text.records.emplace_back(record);
    else
      text.damage.push_back(fmt::format("line {} of the journal is damaged and left out", number));
    at = text.whole = end + 1;
  }
  return text;
}

}  // namespace

JournalText read_journal_file(const fs::path& file) { return text_of(read_file(file, largest)); }

JournalFile::JournalFile(fs::path file, Descriptor descriptor)
    : file_(std::move(file)), descriptor_(std::move(descriptor)) {
  if (!descriptor_.is_open()) throw file_error(file_, "written", errno);
  if (::flock(descriptor_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw JournalInUse(fmt::format("{}: another program is writing this session", file_.parent_path().string()));
}

JournalFile JournalFile::begin(const fs::path& file) {
  constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC;
  return {file, Descriptor(::open(file.c_str(), flags, 0666))};
}

JournalFile JournalFile::go_on(const fs::path& file, JournalText& text, std::uintmax_t known) {
  { const Descriptor regular = open_regular_file(file); }
  JournalFile journal(file, Descriptor(::open(file.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC)));
  const std::uintmax_t size = fs::file_size(file);
  text = known > 0 && size == known ? JournalText{{}, {}, known} : read_journal_file(file);
  journal.size_ = text.whole;
  const bool is_whole = size == text.whole;  // and keeps its time, which people are told
  if (!is_whole && ::ftruncate(journal.descriptor_.get(), static_cast<off_t>(text.whole)) != 0)
    throw file_error(file, "written", errno);
  return journal;
}

void JournalFile::append(std::string_view record) {
  const std::string line = fmt::format("{} {}\n", hash_of(record).crc32, record);
  int error = write_all(descriptor_.get(), line);
  if (error == 0 && ::fdatasync(descriptor_.get()) != 0 && errno != EINVAL && errno != ENOTSUP) error = errno;
  if (error == 0) {
    size_ += line.size();
    return;
  }
  // A part of a line would make the next one unreadable.
  [[maybe_unused]] const int ignored = ::ftruncate(descriptor_.get(), static_cast<off_t>(size_));
  throw file_error(file_, "written", error);
}

}  // namespace nextview
