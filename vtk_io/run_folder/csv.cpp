#include "vtk_io/run_folder/csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "solver/printable.hpp"

namespace porosph {
namespace {

void append_text(std::string& line, std::string_view text) {
  const std::string shown = printable(text);
  if (shown.find_first_of(",\"") == std::string::npos) {
    line += shown;
    return;
  }
  line += '"';
  for (const char c : shown) {
    if (c == '"') line += c;
    line += c;
  }
  line += '"';
}

/// Takes a cell in quotes from the front of the line, up to the comma behind it or the end.
std::string take_quoted(std::string_view& line) {
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != '"') {
      cell += line[i];
    } else if (i + 1 < line.size() && line[i + 1] == '"') {
      cell += line[i++];
    } else {
      line.remove_prefix(i + 1);
      if (!line.empty() && line.front() != ',')
        throw std::invalid_argument("a quote is followed by something else than a comma");
      return cell;
    }
  }
  throw std::invalid_argument("a quote is not closed");
}

std::string take_plain(std::string_view& line) {
  const std::string_view cell = line.substr(0, line.find(','));
  line.remove_prefix(cell.size());
  return std::string(cell);
}

}  // namespace

void append_csv_number(std::string& text, double value) {
  if (std::isnan(value))
    text += "nan";
  else
    fmt::format_to(std::back_inserter(text), "{:.17g}", value);
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    append_text(line, cells[i]);
  }
  return line + '\n';
}

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    cells.push_back(line.starts_with('"') ? take_quoted(line) : take_plain(line));
    if (line.empty()) return cells;
    line.remove_prefix(1);
  }
}

double csv_number(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size())
    throw std::invalid_argument(fmt::format("'{}' is not a number", printable(cell)));
  return value;
}

}  // namespace porosph
