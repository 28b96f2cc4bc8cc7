#include "core/recording/doubted_unit.hpp"

#include <fmt/format.h>

#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

// Far beyond what is scanned as an object, so that data that are merely unusual are not doubted.
constexpr double too_far = 60.0, too_near = 0.002;  // on average [m]
constexpr double too_many = 100.0;                  // times as far apart as they see

std::string file_of(const DescribedDataset& dataset) {
  if (!dataset.description_file.empty()) return dataset.description_file.string();
  return fmt::format("dataset.toml (nextview info {} --write-dataset writes it)", dataset.folder.string());
}

/// " Then depth.scale = 0.001 in dataset.toml mends it"
std::string mended_by(const std::string& entry, const DescribedDataset& dataset) {
  return fmt::format(" Then {} in {} mends it", entry, file_of(dataset));
}

std::string of_ranges(const DescribedDataset& dataset, double apart, double range) {
  const DatasetDescription& d = dataset.description;
  const bool far = range > too_far;
  const std::string doubt = fmt::format("the cameras see {} far on average: are their {} in {}", length_text(range),
                                        d.format == RecordingFormat::depth_images ? "depths" : "points",
                                        far ? "millimetres, not metres?" : "metres, not millimetres?");
  if (d.format == RecordingFormat::depth_images) {
    const bool poses_too = far && apart > too_far;
    const std::string entry = fmt::format("depth.scale = {:g}", d.depth.scale * (far ? 1e-3 : 1e3));
    return doubt + mended_by(entry + (poses_too ? ", with unit = \"mm\" for their poses," : ""), dataset);
  }
  if (d.format == RecordingFormat::clouds || d.format == RecordingFormat::stanford)
    return doubt + mended_by(far ? "unit = \"mm\"" : "unit = \"m\"", dataset);
  return fmt::format("{} Lengths of a {} are taken in metres", doubt, name(d.format));
}

}  // namespace

std::string doubted_unit(const DescribedDataset& dataset, double apart, double range) {
  if (range > too_far || range < too_near) return of_ranges(dataset, apart, range);
  if (!(apart > too_many * range)) return "";
  const std::string doubt =
      fmt::format("the cameras stand {} apart and see {} far on average: are their poses in millimetres, not metres?",
                  length_text(apart), length_text(range));
  const RecordingFormat format = dataset.description.format;
  if (format == RecordingFormat::depth_images) return doubt + mended_by("unit = \"mm\"", dataset);
  return fmt::format("{} Those of {} are to be in the unit of the points", doubt, name(format));
}

}  // namespace nextview
