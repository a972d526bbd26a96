#include "app/bench/csv.hpp"

#include <fmt/format.h>

#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::bench {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string out = "\"";
  for (char c : cell) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

void write_csv(const std::filesystem::path& file, const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) text += quoted(row[i]) + (i + 1 < row.size() ? "," : "\n");
  write_file(file, text);
}

std::string digits(double value) { return fmt::format("{:.9g}", value); }

}  // namespace porosph::bench
