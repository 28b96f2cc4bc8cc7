// A folder of Stanford's range scans: the .conf, and behind a line %%% the scan that all its lines may name.
#include "core/cloud/range_scan_folder.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const auto folder = fuzzed_file("scans/scan.conf", next_part(rest)).parent_path();
  fuzzed_file("scans/scan.ply", rest);
  is_read([&] { read_range_scan_folder(folder); });
  return 0;
}
