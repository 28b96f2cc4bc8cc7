#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/source/scan_source.hpp"

namespace nextview {

/// The file of a capture is gone, or is not what was captured: reading it again will not help, as it might where a call
/// of the operating system has failed.
struct CaptureLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The name of the file that holds a capture: 0001.npy, or 0001.ply of points.
std::string capture_name(const Capture& capture, std::uint32_t number);
/// Writes what a source saw, to the bit, durable when it returns: NUMBER.npy, ranges along the rays as float32 (inf:
/// beyond range, NaN: invalid), or NUMBER.ply, points in the camera frame as doubles [m]. Returns the file's name.
/// @throws std::runtime_error naming the file and the reason
std::string write_capture(const Capture& capture, std::uint32_t number, const std::filesystem::path& folder);

/// What was captured, of the bytes of its file: those whose hash was looked at. Ranges need the camera that took them;
/// points ignore it.
/// @throws std::runtime_error naming the file and the reason
std::variant<DepthImage, std::vector<Vector3>> captured_of(const std::string& bytes, const std::filesystem::path& file,
                                                           const PinholeCamera& camera);

}  // namespace nextview
