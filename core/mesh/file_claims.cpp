#include "core/mesh/file_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>

#include "core/file/counted.hpp"

namespace nextview {
namespace {

std::uint32_t little_endian_32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return c >= ' ' || c == '\n' || c == '\r' || c == '\t'; });
}

/// What a download leaves that was answered by a page.
bool is_web_page(std::string_view bytes) {
  std::string begin(bytes.substr(0, 100));
  begin.erase(0, begin.find_first_not_of("\xEF\xBB\xBF \t\r\n"));
  std::ranges::transform(begin, begin.begin(), [](unsigned char c) { return std::tolower(c); });
  return begin.starts_with("<!doctype html") || begin.starts_with("<html");
}

std::string false_text_stl_claim(std::string_view bytes) {
  // Writers end with "endsolid"; readers do not ask for it, and a part of the surface would be missing in silence.
  const std::string_view tail = bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 1000));
  return tail.find("endsolid") == std::string_view::npos ? "is truncated: an STL text must end with 'endsolid'" : "";
}

std::string false_stl_claim(std::string_view bytes) {
  constexpr std::size_t header = 84, triangle = 50;
  const std::uint64_t triangles = bytes.size() >= header ? little_endian_32(bytes, header - 4) : 0;
  const std::uint64_t expected = header + triangle * triangles;
  if (bytes.size() == expected) return "";
  // Binary headers may begin with "solid" too; only a text has no bytes but characters.
  if (bytes.starts_with("solid") && is_text(bytes.substr(0, 500))) return false_text_stl_claim(bytes);
  if (is_text(bytes.substr(0, 500))) return "is a text, but no STL text, which begins with 'solid'";
  if (bytes.size() < header)
    return "is neither an STL text nor long enough for a binary STL's header; it may be truncated";
  return fmt::format("its STL header claims {}, which {} {} bytes, but the file has {}; it may be truncated",
                     counted(triangles, "triangle", "triangles"), triangles == 1 ? "takes" : "take", expected,
                     bytes.size());
}

/// Takes the next number off the front of `text`; negative if there is none.
std::int64_t take_count(std::string_view& text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return -1;
  text.remove_prefix(start);
  std::int64_t count = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc()) return -1;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return count;
}

/// Takes the next line that holds something besides a comment; empty at the end.
std::string_view take_line(std::string_view& text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start != std::string_view::npos && line[start] != '#') return line;
  }
  return {};
}

bool is_face(std::string_view line, std::int64_t vertices) {
  const std::int64_t corners = take_count(line);
  for (std::int64_t i = 0; i < corners; ++i)
    if (const std::int64_t vertex = take_count(line); vertex < 0 || vertex >= vertices) return false;
  return corners > 0;
}

std::string false_off_claim(std::string_view bytes) {
  const std::size_t keyword = bytes.substr(0, 20).find("OFF");
  if (keyword == std::string_view::npos) return "does not begin with OFF";
  std::string_view rest = bytes.substr(keyword + 3);
  std::string_view counts = take_line(rest);
  const std::int64_t vertices = take_count(counts), faces = take_count(counts), edges = take_count(counts);
  if (vertices < 0 || faces < 0 || edges < 0)
    return "its OFF header must hold the numbers of vertices, faces and edges";
  for (std::int64_t i = 0; i < vertices; ++i)
    if (take_line(rest).empty())
      return fmt::format("its OFF header claims {}, but only {} {}; it may be truncated",
                         counted(vertices, "vertex", "vertices"), counted(i, "line", "lines"),
                         i == 1 ? "follows" : "follow");
  for (std::int64_t i = 0; i < faces; ++i)  // Assimp takes the last vertex for one that is not there.
    if (const std::string_view line = take_line(rest); line.empty() || !is_face(line, vertices))
      return fmt::format("its OFF header claims {} of {}, but face {} is {}", counted(faces, "face", "faces"),
                         counted(vertices, "vertex", "vertices"), i,
                         line.empty() ? "missing; it may be truncated" : "not a list of such vertices");
  return "";
}

std::string false_glb_claim(std::string_view bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  if (bytes.size() < header + chunk_header || !bytes.starts_with("glTF")) return "is not a binary glTF";
  const std::uint64_t length = little_endian_32(bytes, 8);
  for (std::uint64_t chunk = header; chunk + chunk_header <= length && length <= bytes.size();) {
    chunk += chunk_header + little_endian_32(bytes, chunk);
    if (chunk > length) return "one of its glTF chunks claims to be longer than the file; it may be truncated";
  }
  if (length <= bytes.size()) return "";
  return fmt::format("its glTF header claims {} bytes, but the file has {}; it may be truncated", length, bytes.size());
}

std::string false_3mf_claim(std::string_view bytes) {
  if (!bytes.starts_with("PK")) return "is no 3MF, which is a ZIP archive";
  // Its directory is at the end; Assimp says of an archive without one that there is no such file.
  return bytes.find("PK\5\6") == std::string_view::npos ? "its ZIP archive has no end; it may be truncated" : "";
}

}  // namespace

std::string false_claim(std::string_view extension, std::string_view bytes) {
  if (is_web_page(bytes)) return "is a web page, not a mesh: the download went wrong; get the file itself";
  if (extension == ".3mf") return false_3mf_claim(bytes);
  if (bytes.starts_with("PK\3\4")) return "is a ZIP archive, not a mesh: unpack it, or give a 3MF its own ending";
  if (bytes.starts_with("\x1f\x8b")) return "is compressed with gzip, which its name must say: end it in .gz";
  if (extension == ".ply") return false_ply_claim(bytes);
  if (extension == ".stl") return false_stl_claim(bytes);
  if (extension == ".off") return false_off_claim(bytes);
  if (extension == ".glb") return false_glb_claim(bytes);
  return "";
}

}  // namespace nextview
