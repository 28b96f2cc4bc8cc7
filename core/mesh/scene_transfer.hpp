#pragma once
#include <string>
#include <string_view>

#include "core/mesh/assimp_scene.hpp"
#include "core/mesh/reading_process.hpp"

namespace nextview {

// How what a child has read comes through the pipe. Nothing is sent if the other end is closed.

void send_scene(int pipe, const ImportedTriangles& scene);
/// Why there is none; of a long message the beginning.
void send_message(int pipe, std::string_view message);
/// Without taking memory.
void send_out_of_memory(int pipe);

struct ReceivedScene {
  enum class Kind { scene, message, out_of_memory, nothing } kind = Kind::nothing;
  ImportedTriangles scene;
  std::string message;
};

/// The child is not trusted. What it announces is bounded, and takes memory here only as it comes; every index is one
/// of a vertex. What is not as it should be is nothing.
/// @throws ReadingProcess::TooSlow, Stopped
ReceivedScene receive_scene(ReadingProcess& process);

}  // namespace nextview
