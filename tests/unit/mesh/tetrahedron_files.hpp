#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

/// One tetrahedron in every file type, written byte by byte from the formats' descriptions. Corners at 0 and at 2, 3
/// and 4 along the axes, so the bounding box is 2 x 3 x 4; normals outwards.
namespace nextview::tetrahedron_files {

inline constexpr std::array<std::array<float, 3>, 4> corners = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}}};
inline constexpr std::array<std::array<std::uint32_t, 3>, 4> faces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

template <class T>
std::string raw(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

inline std::string number(double value) { return std::to_string(value) + " "; }

inline std::string ply_header(const std::string& format, std::uint64_t vertices, std::uint64_t triangles) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(triangles) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text() {
  std::string text = ply_header("ascii", 4, 4);
  for (const auto& c : corners) text += number(c[0]) + number(c[1]) + number(c[2]) + "\n";
  for (const auto& f : faces)
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

inline std::string ply_binary(bool big_endian) {
  std::string bytes = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian", 4, 4);
  for (const auto& c : corners)
    for (const float x : c) bytes += raw(x, big_endian);
  for (const auto& f : faces) {
    bytes += '\3';
    for (const std::uint32_t i : f) bytes += raw(i, big_endian);
  }
  return bytes;
}

inline std::string stl_text() {
  std::string text = "solid tetrahedron\n";
  for (const auto& f : faces) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const std::uint32_t i : f)
      text += "  vertex " + number(corners[i][0]) + number(corners[i][1]) + number(corners[i][2]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

inline std::string stl_binary(std::uint32_t claimed_triangles = 4) {
  std::string bytes(80, ' ');
  bytes += raw(claimed_triangles);
  for (const auto& f : faces) {
    bytes += std::string(12, '\0');
    for (const std::uint32_t i : f)
      for (const float x : corners[i]) bytes += raw(x);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string obj() {
  std::string text = "# a comment\no tetrahedron\n";
  for (const auto& c : corners) text += "v " + number(c[0]) + number(c[1]) + number(c[2]) + "\n";
  for (const auto& f : faces)
    text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[2] + 1) + "\n";
  return text;
}

inline std::string off() {
  std::string text = "OFF\n4 4 6\n";
  for (const auto& c : corners) text += number(c[0]) + number(c[1]) + number(c[2]) + "\n";
  for (const auto& f : faces)
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

/// The positions, then the indices: what a glTF's buffer holds.
inline std::string gltf_buffer() {
  std::string bytes;
  for (const auto& c : corners)
    for (const float x : c) bytes += raw(x);
  for (const auto& f : faces)
    for (const std::uint32_t i : f) bytes += raw(i);
  return bytes;
}

/// @param buffer "" or "\"uri\": \"name\", "
/// @param nodes the nodes array; the first is the scene's root, mesh 0 is the tetrahedron
inline std::string gltf(const std::string& buffer, const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" + nodes +
         R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "buffers": [{)" + buffer +
         R"("byteLength": 96}], "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
{"buffer": 0, "byteOffset": 48, "byteLength": 48}], "accessors": [
{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 3, 4]},
{"bufferView": 1, "componentType": 5125, "count": 12, "type": "SCALAR"}]})";
}

inline std::string glb() {
  std::string json = gltf("", R"([{"mesh": 0}])");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = gltf_buffer();
  const auto chunk = [](std::string_view type, const std::string& content) {
    return raw(static_cast<std::uint32_t>(content.size())) + std::string(type) + content;
  };
  const std::string chunks = chunk("JSON", json) + chunk(std::string_view("BIN\0", 4), buffer);
  return "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

/// A zip archive without compression.
inline std::string zip(const std::map<std::string, std::string>& files) {
  const auto crc = [](std::string_view bytes) {
    std::uint32_t remainder = ~0u;
    for (const char byte : bytes) {
      remainder ^= static_cast<unsigned char>(byte);
      for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ (remainder & 1 ? 0xedb88320u : 0u);
    }
    return ~remainder;
  };
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const auto size = static_cast<std::uint32_t>(content.size());
    const std::string common = raw<std::uint16_t>(20) + std::string(8, '\0') + raw(crc(content)) + raw(size) +
                               raw(size) + raw(static_cast<std::uint16_t>(name.size())) + std::string(2, '\0');
    directory += "PK\1\2" + raw<std::uint16_t>(20) + common + std::string(10, '\0') +
                 raw(static_cast<std::uint32_t>(archive.size())) + name;
    archive += "PK\3\4" + common + name + content;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  return archive + directory + "PK\5\6" + std::string(4, '\0') + raw(count) + raw(count) +
         raw(static_cast<std::uint32_t>(directory.size())) + raw(static_cast<std::uint32_t>(archive.size())) +
         std::string(2, '\0');
}

inline std::string three_mf(const std::string& unit = R"(unit="millimeter")") {
  std::string model =
      R"(<?xml version="1.0" encoding="UTF-8"?>
<model )" +
      unit + R"( xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" type="model"><mesh><vertices>)";
  for (const auto& c : corners)
    model += "<vertex x=\"" + std::to_string(c[0]) + "\" y=\"" + std::to_string(c[1]) + "\" z=\"" +
             std::to_string(c[2]) + "\"/>";
  model += "</vertices><triangles>";
  for (const auto& f : faces)
    model += "<triangle v1=\"" + std::to_string(f[0]) + "\" v2=\"" + std::to_string(f[1]) + "\" v3=\"" +
             std::to_string(f[2]) + "\"/>";
  model += R"(</triangles></mesh></object></resources><build><item objectid="1"/></build></model>)";
  const std::string types =
      R"(<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)";
  const std::string relations =
      R"(<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
  return zip({{"3D/3dmodel.model", model}, {"[Content_Types].xml", types}, {"_rels/.rels", relations}});
}

/// File name -> content.
inline std::map<std::string, std::string> all() {
  return {{"text.ply", ply_text()},   {"little.ply", ply_binary(false)}, {"big.ply", ply_binary(true)},
          {"text.stl", stl_text()},   {"binary.stl", stl_binary()},      {"tetrahedron.obj", obj()},
          {"tetrahedron.off", off()}, {"tetrahedron.glb", glb()},        {"tetrahedron.3mf", three_mf()}};
}

}  // namespace nextview::tetrahedron_files
