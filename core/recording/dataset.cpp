#include "core/recording/dataset.hpp"

#include <fmt/format.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "core/file/nul_text.hpp"
#include "core/file/read_file.hpp"
#include "core/setting/numbers.hpp"
#include "core/setting/section_of.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Files are small: toml++ takes a table apart by recursion, and a larger one could nest deeper than the stack.
constexpr std::uintmax_t largest_dataset_file = 1 << 15;

const std::vector<std::string> format_names = {"depth-images", "clouds", "stanford", "scan-graph", "scene"};
constexpr const char* intrinsics_form = "four numbers: fx fy cx cy [px], fx and fy over 0";
constexpr const char* offset_form = "three or seven numbers: x y z [m], maybe qx qy qz qw of length 1";
constexpr const char* region_form = "six numbers: the least x y z, the greatest x y z [m]";

bool is_list(const Setting& setting) {
  return setting.key == "intrinsics" || setting.key == "region" || setting.key == "camera_offset";
}

bool holds_text(const Setting& setting) {
  return std::holds_alternative<std::string*>(setting.value) || std::holds_alternative<Setting::Choice>(setting.value);
}

class DatasetReader {
 public:
  explicit DatasetReader(const fs::path& file) : file_(file), settings_(settings(description_)) {}

  DatasetDescription read(const std::string& text) {
    toml::table table;
    try {
      table = toml::parse(text, file_.string());
    } catch (const toml::parse_error& error) {
      throw failure(error.source().begin.line, std::string(error.description()));
    }
    apply(table, "");
    try {
      description_.validate();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", file_.string(), error.what()));
    }
    return description_;
  }

 private:
  void apply(const toml::table& table, const std::string& prefix) {
    for (const auto& [key_of, node] : table) {
      const std::string key = prefix + std::string(key_of.str());
      if (const auto* section = node.as_table(); section && prefix.empty()) {
        apply(*section, key + ".");
        continue;
      }
      const auto line = node.source().begin.line;
      const std::string no_text = why_no_text(key, node.value_or(std::string_view()));
      if (!no_text.empty()) throw failure(line, no_text);
      Setting& setting = known(key, line);
      try {
        setting.set(value_text(setting, node));
        setting.require_in_bounds();
      } catch (const std::invalid_argument& error) {
        throw failure(line, error.what());
      }
    }
  }

  Setting& known(const std::string& key, std::uint32_t line) {
    std::vector<std::string> keys;
    for (Setting& setting : settings_) {
      if (setting.key == key) return setting;
      keys.push_back(setting.key);
    }
    throw failure(line, fmt::format("there is no key '{}'{}", key, did_you_mean(key, keys)));
  }

  std::string value_text(const Setting& setting, const toml::node& node) const {
    if (const auto* list = node.as_array(); list && is_list(setting)) return list_text(setting, *list);
    if (holds_text(setting) != node.is_string())
      throw std::invalid_argument(fmt::format("{} takes {}", setting.key,
                                              is_list(setting)      ? "a list of numbers"
                                              : holds_text(setting) ? "a text in quotes"
                                                                    : "a number without quotes"));
    if (const auto* text = node.as_string()) return text->get();
    return number_text(setting, node);
  }

  std::string list_text(const Setting& setting, const toml::array& list) const {
    std::string text;
    for (const toml::node& entry : list) text += number_text(setting, entry) + " ";
    if (!text.empty()) text.pop_back();
    return text;
  }
  std::string number_text(const Setting& setting, const toml::node& node) const {
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    throw std::invalid_argument(setting.key + " takes numbers");
  }

  std::runtime_error failure(std::uint32_t line, const std::string& reason) const {
    return std::runtime_error(fmt::format("{}:{}: {}", file_.string(), line, reason));
  }

  fs::path file_;
  DatasetDescription description_;
  std::vector<Setting> settings_;
};

/// Whether a key has something to say, to be written.
bool says_something(const DatasetDescription& d, const std::string& key) {
  const bool images = d.format == RecordingFormat::depth_images, clouds = d.format == RecordingFormat::clouds;
  if (key == "format") return true;
  if (key == "frames") return !d.frames.empty();
  if (key == "poses") return !d.poses.empty();
  if (key.starts_with("pose")) return (images || clouds) && !d.poses.empty();
  if (key == "width" || key == "height" || key == "type" || key == "offset") return images && d.depth.width > 0;
  if (key == "camera_offset") return !d.camera_offset.empty();
  if (key == "intrinsics" || key.starts_with("depth.")) return images;
  if (key == "mask") return !d.mask.empty();
  if (key == "unit") return clouds || d.format == RecordingFormat::stanford || d.unit != CloudUnit::automatic;
  return !d.region.empty();
}

std::string value_of(const Setting& setting) {
  if (is_list(setting)) {
    std::istringstream words(setting.text());
    std::string list;
    for (std::string word; words >> word;) list += fmt::format("{}{}", list.empty() ? "" : ", ", word);
    return fmt::format("[{}]", list);
  }
  if (!holds_text(setting)) return setting.text();
  std::ostringstream quoted;
  quoted << toml::value<std::string>(setting.text());
  return quoted.str();
}

}  // namespace

std::vector<Setting> settings(DatasetDescription& d) {
  constexpr Bounds size = zero_or(1, largest_image_side);
  return {
      {"format", "", "what the frames are", choice(d.format, format_names)},
      {"frames", "", "pattern of the frames' files, in order of their names", &d.frames},
      {"width", "px", "of raw images", &d.depth.width, size},
      {"height", "px", "of raw images", &d.depth.height, size},
      {"type", "", "of the values of raw images", choice(d.depth.type, {"uint16", "float32", "float64"})},
      {"offset", "bytes", "of the first value of raw images", &d.depth.offset, from_to(0, 1 << 20)},
      {"poses", "", "pattern of one file a frame, or one file for all", &d.poses},
      {"poses_format", "", "how poses are written",
       choice(d.poses_format, {"matrix4x4", "quaternion_xyzw", "quaternion_wxyz", "tum", "conf"})},
      {"pose_direction", "", "what poses take to what",
       choice(d.pose_direction, {"sensor-to-world", "world-to-sensor"})},
      {"pose_axes", "", "optical: z forward, y down; body: x forward, z up", choice(d.pose_axes, {"optical", "body"})},
      {"camera_offset", "m", "where the camera stands in the one that poses place: x, y, z, maybe qx, qy, qz, qw",
       &d.camera_offset},
      {"intrinsics", "px", "fx, fy, cx, cy", &d.intrinsics},
      {"mask", "", "image of pixels to ignore: those that are not 0", &d.mask},
      {"unit", "", "of the clouds and their poses; of images, of the poses alone",
       choice(d.unit, {"auto", "m", "cm", "mm"})},
      {"region", "m", "box of interest: least x, y, z, greatest x, y, z", &d.region},
      {"depth.scale", "m", "what a value of 1 stands for", &d.depth.scale, over_to(0.0, 1000.0)},
      {"depth.measures", "", "along the camera's z axis, or along the ray", choice(d.depth.measures, {"z", "range"})},
      {"depth.zero", "", "what 0 says: nothing, or that nothing is there", choice(d.depth.zero, {"invalid", "beyond"})},
      {"depth.encoding", "", "rotate3: the bits of the value are rotated by three",
       choice(d.depth.encoding, {"plain", "rotate3"})},
  };
}

PinholeCamera DatasetDescription::camera() const {
  if (intrinsics.empty()) return {0, 0};
  const std::vector<double> v = numbers("intrinsics", intrinsics, 4, intrinsics_form);
  if (!(v[0] > 0.0 && v[1] > 0.0)) throw std::invalid_argument(fmt::format("intrinsics takes {}", intrinsics_form));
  return {0, 0, v[0], v[1], v[2], v[3]};
}

Pose DatasetDescription::offset() const {
  if (camera_offset.empty()) return Pose::Identity();
  std::istringstream words(camera_offset);
  const auto count = std::distance(std::istream_iterator<std::string>(words), {});
  std::vector<double> v = numbers("camera_offset", camera_offset, count == 3 ? 3 : 7, offset_form);
  if (v.size() == 3) v.insert(v.end(), {0, 0, 0, 1});
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) <= 1e-3))
    throw std::invalid_argument(fmt::format("camera_offset takes {}", offset_form));
  return make_pose({v[0], v[1], v[2]}, q);
}

std::optional<Eigen::AlignedBox3d> DatasetDescription::region_box() const {
  if (region.empty()) return std::nullopt;
  const std::vector<double> v = numbers("region", region, 6, region_form);
  const Eigen::AlignedBox3d box(Vector3(v[0], v[1], v[2]), Vector3(v[3], v[4], v[5]));
  if (!((box.max() - box.min()).minCoeff() > 0.0))
    throw std::invalid_argument(fmt::format("region takes {}", region_form));
  return box;
}

void DatasetDescription::validate() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  camera();
  offset();
  region_box();
  require((depth.width == 0) == (depth.height == 0), "width and height are to be given together");
  if (format == RecordingFormat::stanford) return;
  require(!frames.empty(), "the key frames is missing: the pattern of the frames' files");
  if (format != RecordingFormat::depth_images) return;
  require(!poses.empty(), "the key poses is missing: the pattern of the files of poses");
  require(!intrinsics.empty(), "the key intrinsics is missing: [fx, fy, cx, cy]");
}

DatasetDescription read_dataset(const fs::path& file) {
  return DatasetReader(file).read(read_file(file, largest_dataset_file));
}

std::string to_toml(const DatasetDescription& description) {
  DatasetDescription copy = description;
  std::string text = "# Recorded data, as Nextview reads them.\n", section;
  for (const Setting& setting : settings(copy)) {
    if (!says_something(description, setting.key)) continue;
    const std::string room = section_of(setting.key);
    if (room != section) text += fmt::format("\n[{}]\n", room);
    section = room;
    text += fmt::format("{} = {}  # {}\n", setting.key.substr(setting.key.find('.') + 1), value_of(setting),
                        setting.explanation());
  }
  return text;
}

std::string name(RecordingFormat format) { return format_names[static_cast<std::size_t>(format)]; }

}  // namespace nextview
