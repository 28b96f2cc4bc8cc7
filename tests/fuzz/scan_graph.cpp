// OctoMap's scan graphs, binary and text, with the points of their nodes.
#include "core/recording/scan_graph_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  for (const char* name : {"scans.graph", "scans.log"}) {
    const auto file = fuzzed_file(name, {reinterpret_cast<const char*>(data), size});
    is_read([&] {
      for (const ScanGraphNode& node : read_scan_graph(file)) read_scan_graph_points(file, node);
    });
  }
  return 0;
}
