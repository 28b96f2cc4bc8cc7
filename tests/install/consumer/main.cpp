// A program of someone else's: two steps of a scan. Usage: consumer MESH
#include <cstdio>
#include <exception>

#include "core/session/session.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  nextview::Configuration configuration;
  configuration.object.file = argv[1];
  configuration.sensor.width = 80;
  configuration.sensor.height = 60;
  configuration.map.resolution = 0.04;
  configuration.evaluation.surface_samples = 2000;
  nextview::Session session(configuration);
  for (int step = 0; step < 2; ++step) session.step();
  std::printf("%zu views, %.2f of the surface covered\n", session.records().size(), session.records().back().coverage);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "consumer: %s\n", error.what());
  return 2;
}
