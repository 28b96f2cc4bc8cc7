#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/file/descriptor.hpp"

namespace nextview {

/// Another program writes this journal now.
struct JournalInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a journal's file holds.
struct JournalText {
  std::vector<std::string> records;  ///< those that are whole
  std::vector<std::string> damage;   ///< what is not, a line each, for people
  std::uintmax_t whole = 0;          ///< where the last whole record ends [bytes]
};

/// Records that outlive whatever ends the program: one a line, "CHECKSUM RECORD", only ever appended. Whoever has it
/// open is the only one that writes it; the lock goes when the process does.
class JournalFile {
 public:
  /// @throws std::runtime_error naming the file and the reason: it is there, it cannot be written
  static JournalFile begin(const std::filesystem::path& file);
  /// Goes on with one that is there. What was being written when its program ended is cut off. One that is `known`
  /// bytes long was read before: of its text only the length is given.
  /// @throws JournalInUse; std::runtime_error naming the file and the reason
  static JournalFile go_on(const std::filesystem::path& file, JournalText& text, std::uintmax_t known = 0);

  /// Durable when it returns. @throws std::runtime_error naming the file and the reason; then it is as it was.
  /// @pre no line break in `record`
  void append(std::string_view record);

 private:
  JournalFile(std::filesystem::path file, Descriptor descriptor);

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uintmax_t size_ = 0;  // of what is whole
};

/// Also of a journal that someone writes. @throws std::runtime_error naming the file and the reason
JournalText read_journal_file(const std::filesystem::path& file);

}  // namespace nextview
