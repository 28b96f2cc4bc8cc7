// What a driver answers, asked for all that an answer may hold; and the file that it says it captured.
#include "core/driver/driver_capture.hpp"
#include "core/driver/words.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

namespace {

using namespace nextview;

void read_answer(const std::string& line) {
  const DriverAnswer answer(line);
  answer.error();
  is_read([&] { greeting_of(answer); });
  is_read([&] { answer.reaches("reach", 2); });
  is_read([&] { require(is_pose(answer.pose("pose")), "a pose is rigid"); });
  is_read([&] { captured_file_of(answer); });
}

}  // namespace

/// An answer a line; behind a line %%% the captured file.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string answer(next_part(rest));
  is_read([&] { read_answer(answer); });
  is_read([&] { shell_words(answer); });
  for (const char* name : {"scan.npy", "scan.png", "scan.ply"}) {
    const auto folder = fuzzed_file(std::string("driver/") + name, rest).parent_path();
    is_read([&] { read_capture({Pose::Identity(), name, 0.001, "z"}, folder, {4, 3, 10.0, 10.0, 2.0, 1.5}, 1.5); });
  }
  return 0;
}
