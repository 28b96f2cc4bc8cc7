#include "ui/report/html.hpp"

#include <fmt/format.h>

#include "ui/appearance/markup.hpp"

namespace nextview {
namespace {

constexpr const char* style = R"(
:root { --ink: #1b2430; --soft: #5b6675; --line: #d3d9e1; --paper: #ffffff; --shade: #f5f7fa; }
@media (prefers-color-scheme: dark) { :root { --ink: #e9edf2; --soft: #a3aebb; --line: #39424e; --paper: #15191f; --shade: #1c2229; } }
* { box-sizing: border-box; }
body { font: 15px/1.5 Inter, Helvetica, Arial, sans-serif; color: var(--ink); background: var(--paper); margin: 0 auto; max-width: 1120px; padding: 32px 24px 64px; }
h1 { font-size: 28px; margin: 0 0 4px; } h2 { font-size: 20px; margin: 44px 0 8px; } h3 { font-size: 16px; margin: 28px 0 6px; }
p { max-width: 78ch; } .soft, figcaption { color: var(--soft); }
table { border-collapse: collapse; font-size: 13px; margin: 8px 0 16px; display: block; overflow-x: auto; }
th { text-align: left; font-weight: 600; border-bottom: 1px solid var(--soft); padding: 4px 12px 4px 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); padding: 3px 12px 3px 0; font-variant-numeric: tabular-nums; white-space: nowrap; }
.number { text-align: right; }
code, pre { font: 12.5px/1.45 ui-monospace, Menlo, Consolas, monospace; background: var(--shade); border-radius: 3px; }
code { padding: 1px 4px; } pre { padding: 12px; overflow-x: auto; }
figure { margin: 20px 0 28px; } figure svg { max-width: 100%; height: auto; border: 1px solid var(--line); border-radius: 4px; }
figcaption { font-size: 13.5px; max-width: 78ch; }
summary { cursor: pointer; color: var(--soft); margin: 4px 0; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } figure, tr { break-inside: avoid; } }
)";

}  // namespace

std::string html_table(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& cells,
                       std::size_t first_number) {
  const auto row = [&](const std::vector<std::string>& values, const char* tag) {
    std::string text = "<tr>";
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format("<{0}{1}>{2}</{0}>", tag, i < first_number ? "" : " class=\"number\"", values[i]);
    return text + "</tr>\n";
  };
  std::string text = "<table>\n<thead>" + row(columns, "th") + "</thead>\n<tbody>\n";
  for (const auto& values : cells) text += row(values, "td");
  return text + "</tbody>\n</table>\n";
}

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      markup_text(title), style, body);
}

}  // namespace nextview
