// Scripts and demos; a call that was parsed is written and parsed again as the same.
#include "ui/commands/script.hpp"

#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  is_read([&] { parse_script({reinterpret_cast<const char*>(data), size}); });
  return 0;
}
