#include "tests/render/failures_page.hpp"

#include <fmt/format.h>

#include <map>

#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

// Behind the picture's name; the last is a text.
constexpr const char *stored_end = ".expected.png", *drawn_end = ".actual.png", *difference_end = ".difference.png",
                     *reason_end = ".reason.txt";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

std::string cell(const fs::path& folder, const std::string& name, const char* ending) {
  if (!fs::exists(folder / (name + ending))) return "<td>none</td>";
  return fmt::format("<td><a href=\"{0}\"><img src=\"{0}\" alt=\"{0}\"></a></td>", name + ending);
}

}  // namespace

void FailuresPage::add(const std::string& name, const Image* stored, const Image& drawn, const Image& difference,
                       const std::string& reason) const {
  fs::create_directories(folder_);
  remove(name);
  if (stored) write_png(*stored, folder_ / (name + stored_end));
  write_png(drawn, folder_ / (name + drawn_end));
  if (!difference.rgba.empty()) write_png(difference, folder_ / (name + difference_end));
  write_file(folder_ / (name + reason_end), reason);
  write();
}

void FailuresPage::remove(const std::string& name) const {
  bool was_there = false;
  std::error_code error;
  for (const char* ending : {stored_end, drawn_end, difference_end, reason_end})
    was_there |= fs::remove(folder_ / (name + ending), error);
  if (was_there) write();
}

/// Of what lies in the folder, whoever left it: several programs test pictures side by side.
void FailuresPage::write() const {
  std::map<std::string, std::string> rows;  // by name
  for (const auto& entry : fs::directory_iterator(folder_)) {
    std::string name = entry.path().filename();
    if (!name.ends_with(reason_end)) continue;
    name.resize(name.size() - std::string_view(reason_end).size());
    rows[name] = fmt::format("<tr><th colspan=\"3\"><h2>{}</h2>{}</th></tr>\n<tr>{}{}{}</tr>\n", name,
                             escaped(read_file(entry.path())), cell(folder_, name, stored_end),
                             cell(folder_, name, drawn_end), cell(folder_, name, difference_end));
  }
  std::string page =
      "<!doctype html><meta charset=\"utf-8\"><title>Pictures that differ</title>\n<style>body{font-family:sans-serif}"
      "table{width:100%;table-layout:fixed}th{text-align:left;font-weight:normal}img{max-width:100%;border:1px solid "
      "#ccc}</style>\n";
  page += fmt::format("<h1>{} pictures differ</h1>\n", rows.size());
  page += "<p>If a change is meant: <code>tests/update-screenshots NAME</code></p>\n";
  page += "<table>\n<tr><td>stored</td><td>drawn</td><td>difference</td></tr>\n";
  for (const auto& [name, row] : rows) page += row;
  write_file(file(), page + "</table>\n");
}

}  // namespace nextview
