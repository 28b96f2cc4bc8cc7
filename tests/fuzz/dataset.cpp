// dataset.toml; what is written of one is read again as the same.
#include "core/recording/dataset.hpp"

#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const auto file = fuzzed_file("dataset.toml", {reinterpret_cast<const char*>(data), size});
  const auto rewritten = [](const std::filesystem::path& from) {
    return fuzzed_file("again.toml", to_toml(read_dataset(from)));
  };
  is_read([&] {
    const std::string text = to_toml(read_dataset(rewritten(file)));  // -0 is 0 by then
    require(to_toml(read_dataset(fuzzed_file("again.toml", text))) == text,
            "a description that was written is the same");
  });
  return 0;
}
