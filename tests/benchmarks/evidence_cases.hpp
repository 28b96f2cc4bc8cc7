#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/offline/refinement.hpp"

namespace nextview {

/// What looks at the objects of a comparison of maps.
struct EvidenceSensor {
  std::string_view key;   ///< on the command line
  std::string_view name;  ///< for people
  int width;              ///< [px]; three quarters of it high
  double noise;           ///< of ranges [m]
  double outliers;        ///< share of pixels
  double resolution;      ///< of the map [m]
  bool compared;          ///< the conventional map's terms are fitted for it
};

/// A small, noisy camera with outliers, and the program's own; to fit to, one between them, and large voxels too.
inline constexpr EvidenceSensor fitting_sensors[] = {{"small", "160x120, 5 mm", 160, 0.005, 0.01, 0.01, true},
                                                     {"between", "320x240, 3 mm", 320, 0.003, 0.0, 0.01, false},
                                                     {"default", "640x480, 2 mm", 640, 0.002, 0.0, 0.01, true},
                                                     {"large", "640x480, large voxels", 640, 0.002, 0.0, 0.02, false}};

/// Scans of an object whose surface is known: what maps are fitted to, or, held out, compared on. The object is
/// 0.5 m long and not aligned with them.
struct EvidenceCase {
  std::string object;
  EvidenceSensor sensor;
  int views = 0;
  VoxelGrid grid;
  std::vector<Scan> scans;
  RefinementTruth truth;
};

/// `object`: "part <number>", a made-up part (training_part); else what `object.file` takes. Views lie on a Fibonacci
/// sphere of 0.9 m. @throws std::runtime_error if there is no such object
EvidenceCase evidence_case(const std::string& object, const EvidenceSensor& sensor, int views);

/// Made-up parts: everything that is fitted is fitted to these.
std::span<const char* const> fitting_parts();
/// Objects that nothing was fitted to, those of them that are installed.
std::vector<std::string> held_out_objects();

}  // namespace nextview
