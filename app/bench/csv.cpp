#include "app/bench/csv.hpp"

#include <fmt/format.h>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph::bench {

void write_csv(const std::filesystem::path& file, const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) text += csv_line(row);
  write_file(file, text);
}

std::string digits(double value) { return fmt::format("{:.9g}", value); }

}  // namespace porosph::bench
