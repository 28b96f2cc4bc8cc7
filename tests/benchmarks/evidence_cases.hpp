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
  double max_range;       ///< [m]
  bool compared;          ///< the conventional map's terms are fitted for it
};

/// A small, noisy camera with outliers, and the program's own; to fit to, one between them, large voxels, and a camera
/// that reaches only what is near, too.
inline constexpr EvidenceSensor fitting_sensors[] = {
    {"small", "160x120, 5 mm", 160, 0.005, 0.01, 0.01, 1.5, true},
    {"between", "320x240, 3 mm", 320, 0.003, 0.0, 0.01, 1.5, false},
    {"default", "640x480, 2 mm", 640, 0.002, 0.0, 0.01, 1.5, true},
    {"large", "640x480, large voxels", 640, 0.002, 0.0, 0.02, 1.5, false},
    {"short", "160x120, short-sighted", 160, 0.005, 0.0, 0.02, 0.75, false}};

/// How an object lies in the map. Walls of a part that is placed as the program does lie along the voxels, some of them
/// right on their borders; turned about all axes, everywhere.
enum class EvidencePose { as_placed, turned };
constexpr const char* name_of(EvidencePose pose) { return pose == EvidencePose::turned ? "turned" : "as placed"; }

/// Scans of an object whose surface is known: what maps are fitted to, or, held out, compared on. The object is
/// 0.5 m long.
struct EvidenceCase {
  std::string object;
  EvidencePose pose;
  EvidenceSensor sensor;
  int views = 0;
  VoxelGrid grid;
  std::vector<Scan> scans;
  RefinementTruth truth;
};

/// `object`: "part <number>" or another made-up one (fitting_parts); else what `object.file` takes. Views lie on a
/// Fibonacci sphere of 0.9 m. @throws std::runtime_error if there is no such object
EvidenceCase evidence_case(const std::string& object, EvidencePose pose, const EvidenceSensor& sensor, int views);

/// The voxels that scores near the surface are of, a mark each.
std::vector<std::uint8_t> scored_voxels(const EvidenceCase& c);
/// Whether voxels' centres are inside; a half where a face goes right through one: on which side that is, rounding
/// alone tells, and of another part it tells otherwise.
std::vector<float> centres_inside(const EvidenceCase& c);
/// Of those of a half, nothing near the surface is scored any more, by either truth. Returns their share of it.
double leave_out_undecided_centres(EvidenceCase& c);

/// Made-up parts: everything that is fitted is fitted to these.
struct FittingPart {
  std::string object;
  EvidencePose pose;
};
std::vector<FittingPart> fitting_parts();
/// Objects that nothing was fitted to, those of them that are installed.
std::vector<std::string> held_out_objects();

}  // namespace nextview
