#pragma once
#include "core/recording/dataset_guess.hpp"
#include "core/recording/recording.hpp"

namespace nextview {

/// The frames of a recording, none of them read as yet but those of formats that come as a whole; its camera, extent
/// and points are not known then. Unit: [m] for one of the clouds or Stanford's scans, and of poses.
/// @throws std::runtime_error with one line that names the file or folder and the reason
Recording list_frames(const DescribedDataset& dataset, const RecordingOptions& options, double unit);

}  // namespace nextview
