#include "render/report/html.hpp"

#include <fmt/format.h>

#include "render/report/resources.hpp"
#include "solver/printable.hpp"

namespace porosph::html {
namespace {

/// Subscripts as shown_label writes them, "_{yy}".
std::string with_subscripts(std::string text) {
  for (std::size_t at;
       (at = text.find("_{")) != std::string::npos && text.find('}', at) != std::string::npos;) {
    text.replace(text.find('}', at), 1, "</sub>");
    text.replace(at, 2, "<sub>");
  }
  return text;
}

std::string row(const std::vector<std::string>& cells, const char* first, const char* other) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    text += fmt::format("<{0}>{2}</{1}>", i == 0 ? first : other,
                        i == 0 ? "th" : std::string(other).substr(0, 2), with_subscripts(escaped(cells[i])));
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
      escaped(title), resources::report_style, body);
}

}  // namespace porosph::html
