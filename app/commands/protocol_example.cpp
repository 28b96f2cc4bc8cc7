#include "app/commands/protocol_example.hpp"

#include <fmt/format.h>

#include <sstream>
#include <vector>

#include "core/driver/driver_protocol.hpp"
#include "core/driver/driver_server.hpp"
#include "core/file/json_text.hpp"
#include "core/file/own_folder.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

/// A square of 20 cm in the plane z = 0.
TriangleMesh square() {
  return {{{-0.1f, -0.1f, 0}, {0.1f, -0.1f, 0}, {0.1f, 0.1f, 0}, {-0.1f, 0.1f, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

std::vector<std::string> requests() {
  const std::string above = "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0.5, 0, 0, 0, 1]",
                    beside = "[0, 0, -1, 0.3, 1, 0, 0, 0, 0, -1, 0, 0.1, 0, 0, 0, 1]";
  return {fmt::format(R"({{"id": 1, "request": "hello", "protocol": {}}})", driver_protocol_version),
          fmt::format(R"({{"id": 2, "request": "reach", "from": {}, "poses": [{}]}})", above, beside),
          fmt::format(R"({{"id": 3, "request": "move", "pose": {}}})", beside),
          R"({"id": 4, "request": "capture", "step": 1, "seed": 1, "folder": "/path"})",
          R"({"id": 5, "request": "dance"})",
          R"({"id": 6, "request": "bye"})"};
}

}  // namespace

std::string protocol_example() {
  const OwnFolder folder;  // for what is captured
  DepthCameraConfig sensor;
  sensor.width = 4;
  sensor.height = 3;
  PlacedMesh placed;
  placed.mesh = square();
  const auto world =
      std::make_shared<const SimulatedWorld>(std::make_shared<const PlacedMesh>(std::move(placed)), sensor);
  Pose start = Pose::Identity();
  start.translation().z() = 0.5;
  start.linear().diagonal() << 1, -1, -1;
  FreeFlyingCamera robot(start);
  SourceDescription description = SimulatedSource(world, 1).describe();
  description.start = start;
  std::string sent, text;
  for (std::string request : requests()) {
    if (const auto at = request.find("/path"); at != request.npos) request.replace(at, 5, folder.path().string());
    sent += request + '\n';
  }
  std::istringstream in(sent);
  std::ostringstream out;
  serve({"simulated camera",
         {"stop", "simulated"},
         description,
         "",
         robot,
         [&](std::uint64_t seed) { return std::make_unique<SimulatedSource>(world, seed); },
         1,
         {}},
        in, out);
  std::istringstream answers(out.str());
  for (const std::string& request : requests()) {
    text += "→ " + request + '\n';
    if (std::string answer; std::getline(answers, answer)) text += "← " + answer + '\n';
  }
  return text;
}

}  // namespace nextview
