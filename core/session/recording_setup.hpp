#pragma once
#include <memory>
#include <stop_token>

#include "core/config/configuration.hpp"
#include "core/evaluation/recorded_surface.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/registration/alignment.hpp"
#include "core/source/recorded_source.hpp"

namespace nextview {

// What a session on recorded data is made of.

/// Opens the recording that a configuration names, a folder that `scan` wrote among them, and lets what was not given
/// follow it: lengths (fit_lengths) and the region from its extent, the camera, and the end: when all frames are used.
/// Of a scan's folder everything but object, recording and end is as it was there.
/// @throws std::runtime_error, std::invalid_argument naming the file or the setting; OutOfMemory; Stopped
std::unique_ptr<RecordedSource> open_configured_recording(Configuration& configuration, const Progress& progress,
                                                          const std::stop_token& stop);

/// The frames that views.csv of a scan of this recording says were taken.
/// @throws std::runtime_error naming the file, and the line where it is wrong inside
std::vector<View> frames_listed(const std::filesystem::path& file, const RecordedSource& source);

/// The frame that `recorded.start` names. @throws std::invalid_argument if there is none of this name or number.
std::uint32_t start_frame(const Configuration& configuration, const Recording& recording);

/// What its frames, cleaned, show together. @throws std::runtime_error naming the file; Stopped
std::shared_ptr<const RecordedSurface> recorded_surface(const Configuration& configuration, const Recording& recording,
                                                        const Progress& progress, const std::stop_token& stop);

/// The mesh of what was scanned, where the scans show it.
struct AlignedTruth {
  std::filesystem::path file;
  std::shared_ptr<const PlacedMesh> placed;
  Alignment alignment;  ///< of the scans with the mesh as its file has it
};
/// How well they agree, for people; where they hardly do, what may be the reason.
std::string alignment_note(const Alignment& alignment, const std::string& mesh_name, const PointCloud& scanned,
                           const TriangleMesh& mesh);
/// @throws std::runtime_error, std::invalid_argument naming the file; Stopped
AlignedTruth aligned_truth(const Configuration& configuration, const PointCloud& scanned, const std::stop_token& stop);

}  // namespace nextview
