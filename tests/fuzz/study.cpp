// Studies, and the results of their runs.
#include "core/study/run_result.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = fuzzed_file("study.toml", bytes);
  is_read([&] { read_study(file); });
  const auto result = fuzzed_file("result.json", bytes);
  is_read([&] { read_result(result); });
  return 0;
}
