// Configurations, and pictures that carry one; what is written of one is read again as the same.
#include "core/config/configuration.hpp"

#include "core/file/png_text.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto picture = fuzzed_file("picture.png", bytes);
  is_read([&] { png_configuration(picture); });
  const auto file = fuzzed_file("config.toml", bytes);
  is_read([&] {
    const std::string text = to_toml(read_configuration(file));
    const auto again = fuzzed_file("again.toml", text);
    require(to_toml(read_configuration(again)) == text, "a configuration that was written is the same");
  });
  return 0;
}
