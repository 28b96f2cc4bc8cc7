// Scenes: scans and views as text.
#include "core/sensor/recorded_scans.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const auto file = fuzzed_file("scene.txt", {reinterpret_cast<const char*>(data), size});
  is_read([&] { read_recorded_scene(file); });
  return 0;
}
