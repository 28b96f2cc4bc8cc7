#include "core/mesh/declared_unit.hpp"

#include <assimp/scene.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <regex>
#include <string>
#include <utility>

#include "core/file/lower_case.hpp"

namespace nextview {
namespace {

constexpr std::array<std::pair<std::string_view, LengthUnit>, 7> named_units = {
    {{"micron", LengthUnit::micrometres},
     {"millimeter", LengthUnit::millimetres},
     {"centimeter", LengthUnit::centimetres},
     {"inch", LengthUnit::inches},
     {"foot", LengthUnit::feet},
     {"feet", LengthUnit::feet},
     {"meter", LengthUnit::metres}}};

constexpr std::size_t begin_of_text = 4096;  ///< in which the root element stands [bytes]

LengthUnit unit_of_text(std::string_view text) {
  static const std::regex attribute(R"(<(\w+:)?(model|amf)\s[^>]*\bunit\s*=\s*["'](\w+)["'])");
  const std::string begin(text.substr(0, begin_of_text));
  std::smatch match;
  if (!std::regex_search(begin, match, attribute)) return LengthUnit::automatic;
  for (const auto& [word, unit] : named_units)
    if (match[3] == std::string(word)) return unit;
  return LengthUnit::automatic;
}

/// The beginning of what was deflated; empty if that is damaged.
std::string inflated(std::string_view bytes) {
  z_stream stream{};
  constexpr int without_header = -MAX_WBITS;
  if (inflateInit2(&stream, without_header) != Z_OK) return "";
  std::string text(begin_of_text, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(std::min(bytes.size(), 2 * begin_of_text));
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  const int result = inflate(&stream, Z_SYNC_FLUSH);
  inflateEnd(&stream);
  text.resize(result == Z_OK || result == Z_STREAM_END ? text.size() - stream.avail_out : 0);
  return text;
}

std::uint32_t number(std::string_view bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = size - 1; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Of the first model in a ZIP archive that declares one, by its directory.
LengthUnit unit_of_archive(std::string_view bytes) {
  constexpr std::size_t entry_size = 46, local_size = 30;
  for (std::size_t at = bytes.find("PK\1\2"); at != bytes.npos && at + entry_size <= bytes.size();
       at = bytes.find("PK\1\2", at + entry_size)) {
    const std::string_view name = bytes.substr(at + entry_size, number(bytes, at + 28, 2));
    const std::size_t local = number(bytes, at + 42, 4);
    if (!name.ends_with(".model") || local + local_size > bytes.size()) continue;
    const std::size_t data = local + local_size + number(bytes, local + 26, 2) + number(bytes, local + 28, 2);
    if (data > bytes.size()) continue;
    const bool is_deflated = number(bytes, at + 10, 2) == Z_DEFLATED;
    const std::string text =
        is_deflated ? inflated(bytes.substr(data)) : std::string(bytes.substr(data, begin_of_text));
    if (const LengthUnit unit = unit_of_text(text); unit != LengthUnit::automatic) return unit;
  }
  return LengthUnit::automatic;
}

LengthUnit unit_of_fbx(const aiScene& scene) {
  float centimetres = 1.0f;
  if (!scene.mMetaData || !scene.mMetaData->Get("UnitScaleFactor", centimetres)) return LengthUnit::automatic;
  for (const auto& [word, unit] : named_units)
    if (std::abs(0.01 * centimetres / metres_per(unit) - 1.0) < 1e-3) return unit;
  return LengthUnit::automatic;
}

/// What was written into the head of an STL or PLY, which have no place of their own for it: "unit mm", "UNITS=mm".
LengthUnit unit_of_head(std::string_view head) {
  static const std::regex remark(R"(\bunits?\s*[ =:]\s*(um|mm|cm|m|inch|inches|ft)\b)", std::regex::icase);
  const std::string text(head.substr(0, head.find('\0')));
  std::smatch match;
  if (!std::regex_search(text, match, remark)) return LengthUnit::automatic;
  const std::string word = lower_case(match[1] == "inches" ? "inch" : match[1].str());
  for (const auto& [ignored, unit] : named_units)
    if (name(unit) == word) return unit;
  return LengthUnit::automatic;
}

}  // namespace

LengthUnit declared_unit(std::string_view extension, std::string_view bytes, const aiScene& scene) {
  if (extension == ".3mf") return unit_of_archive(bytes);
  if (extension == ".amf") return unit_of_text(bytes);
  if (extension == ".fbx") return unit_of_fbx(scene);
  if (extension == ".stl") return unit_of_head(bytes.substr(0, 80));
  if (extension == ".ply") return unit_of_head(bytes.substr(0, std::min(bytes.find("element"), begin_of_text)));
  return LengthUnit::automatic;
}

}  // namespace nextview
