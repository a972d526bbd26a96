// Comma-separated values: the one form of the tables that the program writes and reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porosph {

/// Adds a number with all the digits that it needs to read as the same one; nan without a sign.
void append_csv_number(std::string& text, double value);

/// Cells between commas, with a line break behind them. A cell with a comma or a quote stands in quotes, its
/// own quotes doubled; control characters are shown by their codes.
std::string csv_line(const std::vector<std::string>& cells);

/// The cells of a line that is given without its line break. Throws std::invalid_argument for a quote that is
/// not closed, or that is followed by anything but a comma.
std::vector<std::string> csv_cells(std::string_view line);

/// The number in a cell. Throws std::invalid_argument where there is none.
double csv_number(std::string_view cell);

}  // namespace porosph
