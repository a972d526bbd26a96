#include "render/report/html.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <string_view>

#include "render/report/resources.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph::render::html {
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

/// Small letters and digits, with '-' in place of all others.
std::string anchor(const std::string& heading) {
  std::string name;
  for (const char c : heading) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const bool is_capital = c >= 'A' && c <= 'Z';
    name += is_plain ? c : is_capital ? static_cast<char>(c - 'A' + 'a') : '-';
  }
  return name;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (bytes.size() + 2) / 3);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (int k = 3; k >= 0; --k) text += digits[group >> (6 * k) & 63];
  }
  if (const std::size_t rest = bytes.size() % 3; rest > 0)
    text.replace(text.size() - 3 + rest, 3 - rest, 3 - rest, '=');
  return text;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ReadError(file, std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), {}};
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

namespace {

/// `lazy`: where only some windows show the picture.
std::string linked(const std::string& file, const std::string& description, bool lazy) {
  return fmt::format("<a href=\"{0}\"><img src=\"{0}\"{2} alt=\"{1}\"></a>", escaped(file),
                     escaped(description), lazy ? " loading=\"lazy\"" : "");
}

}  // namespace

std::string figure(const std::string& file, const std::string& description, const std::string& caption,
                   const std::vector<std::string>& panels) {
  if (panels.empty())
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", linked(file, description, false),
                       escaped(caption));
  std::string narrow;
  for (std::size_t i = 0; i < panels.size(); ++i)
    narrow += linked(panels[i],
                     panels.size() == 1 ? description
                                        : fmt::format("{}, {} of {}", description, i + 1, panels.size()),
                     true) +
              "\n";
  return fmt::format(
      "<figure><div class=\"wide\">{}</div>\n<div class=\"narrow\">\n{}</div>"
      "<figcaption>{}</figcaption></figure>\n",
      linked(file, description, true), narrow, escaped(caption));
}

std::string player(const std::vector<Instant>& frames, const std::string& description) {
  std::string text =
      fmt::format("<div class=\"player\" aria-label=\"{}\">\n<ol class=\"strip\">\n", escaped(description));
  for (const Instant& frame : frames)
    text += fmt::format("<li><figure>{}<figcaption>{}</figcaption></figure></li>\n",
                        linked(frame.file, description + ", " + frame.caption, true), escaped(frame.caption));
  return text + "</ol>\n</div>\n";
}

std::string slider(const Instant& a, const Instant& b) {
  std::string text = "<div class=\"slider\">\n";
  for (const Instant* side : {&a, &b})
    text += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        linked(side->file, side->caption, false), escaped(side->caption));
  return text + "</div>\n";
}

std::string paragraph(const std::string& text, const std::string& style) {
  return fmt::format("<p{}>{}</p>\n", style.empty() ? "" : " class=\"" + style + "\"", escaped(text));
}

std::string section(const std::string& heading, const std::string& content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", anchor(heading), escaped(heading),
                     content);
}

std::string contents(const std::string& body) {
  static const std::regex head("<section id=\"([^\"]*)\">\n<h2>(.*)</h2>");
  std::string text = "<nav aria-label=\"Contents\"><ul>\n";
  for (std::sregex_iterator i(body.begin(), body.end(), head), end; i != end; ++i)
    text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", (*i)[1].str(), (*i)[2].str());
  return text + "</ul></nav>\n";
}

std::vector<std::string> pictures_of(const std::string& page) {
  static const std::regex source("<img src=\"([^\"]*)\"");
  std::vector<std::string> files;
  for (std::sregex_iterator i(page.begin(), page.end(), source), end; i != end; ++i) files.push_back((*i)[1]);
  return files;
}

std::string with_pictures(std::string page, const std::filesystem::path& folder) {
  for (const std::string& file : pictures_of(page)) {
    const std::string link = fmt::format("<a href=\"{0}\"><img src=\"{0}\"", file);
    const std::string data = "<img src=\"data:image/png;base64," + base64(read_file(folder / file)) + "\"";
    if (const auto at = page.find(link); at != std::string::npos) page.replace(at, link.size(), "<a>" + data);
  }
  return page;
}

std::string page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n{}<script>\n{}</script>\n</body>\n</html>\n",
      escaped(title), resources::report_style, body, resources::report_script);
}

}  // namespace porosph::render::html
