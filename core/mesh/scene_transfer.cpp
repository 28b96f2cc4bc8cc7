#include "core/mesh/scene_transfer.hpp"

#include <algorithm>

#include "core/file/descriptor.hpp"

namespace nextview {
namespace {

/// Comes first. Then the message, or the vertices and the triangles.
struct TransferHeader {
  std::uint64_t out_of_memory = 0, message = 0, vertices = 0, triangles = 0, unit = 0;
};
constexpr std::uint64_t longest_message = 1 << 12;  // [bytes]

bool send(int pipe, const void* data, std::size_t size) {
  return write_all(pipe, {static_cast<const char*>(data), size}) == 0;
}

template <class T>
bool send(int pipe, const std::vector<T>& values) {
  return send(pipe, values.data(), values.size() * sizeof(T));
}

template <class T>
bool receive(ReadingProcess& process, std::uint64_t count, std::vector<T>& values) {
  constexpr std::size_t at_once = (std::size_t{1} << 22) / sizeof(T);
  values.reserve(count);  // Addresses; memory is taken as it is filled, that is, with what comes.
  while (values.size() < count) {
    const std::size_t before = values.size(), now = std::min<std::size_t>(at_once, count - before);
    values.resize(before + now);
    if (!process.receive(values.data() + before, now * sizeof(T))) return false;
  }
  return true;
}

bool has_valid_indices(const ImportedTriangles& scene) {
  for (const auto& triangle : scene.triangles)
    for (const std::uint32_t vertex : triangle)
      if (vertex >= scene.vertices.size()) return false;
  return true;
}

}  // namespace

void send_scene(int pipe, const ImportedTriangles& scene) {
  const TransferHeader header = {0, 0, scene.vertices.size(), scene.triangles.size(),
                                 static_cast<std::uint64_t>(scene.unit)};
  send(pipe, &header, sizeof(header)) && send(pipe, scene.vertices) && send(pipe, scene.triangles);
}

void send_message(int pipe, std::string_view message) {
  message = message.substr(0, longest_message);
  const TransferHeader header = {0, message.size(), 0, 0, 0};
  send(pipe, &header, sizeof(header)) && send(pipe, message.data(), message.size());
}

void send_out_of_memory(int pipe) {
  const TransferHeader header = {1, 0, 0, 0, 0};
  send(pipe, &header, sizeof(header));
}

ReceivedScene receive_scene(ReadingProcess& process) {
  using Kind = ReceivedScene::Kind;
  TransferHeader header;
  if (!process.receive(&header, sizeof(header))) return {};
  ReceivedScene received;
  if (header.out_of_memory) {
    received.kind = Kind::out_of_memory;
  } else if (header.message > 0 && header.message <= longest_message) {
    received.message.resize(header.message);
    if (process.receive(received.message.data(), received.message.size())) received.kind = Kind::message;
  } else if (header.message == 0 && header.vertices <= max_vertices && header.triangles <= max_triangles &&
             header.unit <= static_cast<std::uint64_t>(LengthUnit::micrometres)) {
    received.scene.unit = static_cast<LengthUnit>(header.unit);
    if (receive(process, header.vertices, received.scene.vertices) &&
        receive(process, header.triangles, received.scene.triangles) && has_valid_indices(received.scene))
      received.kind = Kind::scene;
  }
  return received;
}

}  // namespace nextview
