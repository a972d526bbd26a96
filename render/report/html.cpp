#include "render/report/html.hpp"

#include <fmt/format.h>

#include "solver/printable.hpp"

namespace porosph::html {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --text: #1c1e21; --faint: #5b6169; --back: #fff; --panel: #f4f5f7; --line: #d5d9de;
  --warn: #fff4d6; --warn-line: #c98a00; }
@media (prefers-color-scheme: dark) { :root { --text: #e6e8eb; --faint: #a3aab3; --back: #17191c; --panel: #22262b;
  --line: #3b4149; --warn: #3a2f12; --warn-line: #d9a52b; } }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--text); background: var(--back);
  max-width: 1200px; margin: 0 auto; padding: 1.5rem; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .8rem; border-bottom: 1px solid var(--line); padding-bottom: .25rem; }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
.lead, figcaption { color: var(--faint); }
figure { margin: 1rem 0; }
img { max-width: 100%; height: auto; display: block; margin: 0 auto; background: #fff; border: 1px solid var(--line);
  border-radius: 4px; }
figcaption { font-size: .9rem; margin-top: .4rem; }
.scroll { overflow-x: auto; margin: .5rem 0 1rem; }
table { border-collapse: collapse; font-size: .9rem; overflow-wrap: normal; }
th, td { padding: .3rem .7rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
thead th { background: var(--panel); }
tbody th { font-weight: normal; }
table.numbers td, table.numbers thead th + th { text-align: right; font-variant-numeric: tabular-nums;
  white-space: nowrap; }
.warnings { background: var(--warn); border-left: 4px solid var(--warn-line); padding: .6rem 1rem; }
.warnings ul { margin: 0; padding-left: 1.2rem; }
pre { background: var(--panel); padding: .8rem; overflow-x: auto; font-size: .85rem; white-space: pre-wrap; }
@media print { :root { --text: #000; --faint: #444; --back: #fff; --panel: #f4f5f7; --line: #bbb; --warn: #fff4d6; }
  body { max-width: none; padding: 0; font-size: 10pt; } h2 { break-after: avoid; } figure, table { break-inside: avoid; }
  img { max-height: 22cm; width: auto; } }
)";

std::string row(const std::vector<std::string>& cells, const char* first, const char* other) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    text += fmt::format("<{0}>{2}</{1}>", i == 0 ? first : other,
                        i == 0 ? "th" : std::string(other).substr(0, 2), escaped(cells[i]));
  return text + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : printable_lines(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string table(const std::vector<std::vector<std::string>>& rows, bool numbers) {
  std::string text = fmt::format("<div class=\"scroll\"><table{}>\n<thead>{}</thead>\n<tbody>\n",
                                 numbers ? " class=\"numbers\"" : "",
                                 row(rows.front(), "th scope=\"col\"", "th scope=\"col\""));
  for (std::size_t i = 1; i < rows.size(); ++i) text += row(rows[i], "th scope=\"row\"", "td");
  return text + "</tbody>\n</table></div>\n";
}

std::string figure(const std::string& file, const std::string& description, const std::string& caption) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                     escaped(file), escaped(description), escaped(caption));
}

std::string paragraph(const std::string& text, const std::string& style) {
  return fmt::format("<p{}>{}</p>\n", style.empty() ? "" : " class=\"" + style + "\"", escaped(text));
}

std::string section(const std::string& heading, const std::string& content) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escaped(heading), content);
}

std::string page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      escaped(title), style, body);
}

}  // namespace porosph::html
