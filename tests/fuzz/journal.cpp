// Journals: as a file, whose check sums few inputs have, and as records; and the captures of a session.
#include "core/file/read_file.hpp"
#include "core/journal/capture_file.hpp"
#include "core/journal/journal_records.hpp"
#include "core/session/camera_bookmarks.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto folder = fuzzed_file("session/journal", bytes).parent_path();
  is_read([&] { read_journal(folder); });
  Journal journal;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    try {
      read_record(std::string(rest.substr(0, end)), journal);
    } catch (const std::exception&) {  // any, as its declaration says
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  journal.line();
  fuzzed_file("session/cameras.json", bytes);
  is_read([&] { read_cameras(folder); });
  for (const char* name : {"0001.npy", "0001.ply"}) {
    const auto file = fuzzed_file(name, bytes);
    is_read([&] { captured_of(read_file(file), file, {4, 3, 10.0, 10.0, 2.0, 1.5}); });
  }
  return 0;
}
