// The main of a fuzzer that is built without libFuzzer: does what it does with each file of the folders or files that
// are named, in the order of their names.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "core/file/read_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) files.emplace_back(argv[i]);
    if (fs::is_directory(argv[i]))
      for (const auto& entry : fs::directory_iterator(argv[i])) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const std::string bytes = nextview::read_file(file);
    std::fprintf(stderr, "%s\n", file.c_str());  // the last one is the one that ends it
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 2 : 0;
}
