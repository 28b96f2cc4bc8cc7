// What comes through the pipe from the process that reads meshes, which is not trusted.
#include "core/mesh/scene_transfer.hpp"

#include <unistd.h>

#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const auto send = [&](int pipe) {
    for (std::size_t sent = 0; sent < size;) {
      const ssize_t more = ::write(pipe, data + sent, size - sent);
      if (more <= 0) break;
      sent += static_cast<std::size_t>(more);
    }
    ::_exit(0);
  };
  ReadingProcess process(send, std::chrono::seconds(10), {});
  ReceivedScene received;
  try {
    received = receive_scene(process);
  } catch (const ReadingProcess::TooSlow&) {  // a machine that has much else to do
  }
  for (const auto& triangle : received.scene.triangles)
    for (const std::uint32_t vertex : triangle)
      require(received.kind != ReceivedScene::Kind::scene || vertex < received.scene.vertices.size(),
              "every index is one of a vertex");
  return 0;
}
