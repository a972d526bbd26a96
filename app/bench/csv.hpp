// Tables for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace porosph::bench {

/// Rows of cells, the first the heads; cells with commas or quotes are quoted. Throws WriteError.
void write_csv(const std::filesystem::path& file, const std::vector<std::vector<std::string>>& rows);

/// All digits of a number.
std::string digits(double value);

}  // namespace porosph::bench
