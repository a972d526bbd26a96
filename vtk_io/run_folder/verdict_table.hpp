// <sweep>.csv: the verdicts of a sweep, a row as soon as a run is finished.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/sweep/verdict.hpp"
#include "vtk_io/run_folder/descriptor.hpp"

namespace porosph {

/// One row. Numbers that are not finite are empty cells.
struct VerdictRow {
  std::string x, y;         ///< labels of the point
  std::string fingerprint;  ///< of its complete case
  Verdict verdict;
};

/// Throws WriteError.
void write_verdicts(const std::filesystem::path& file, const std::vector<VerdictRow>& rows);

/// Rows of a table that write_verdicts or VerdictWriter wrote; a torn last row is left out. Throws ReadError.
std::vector<VerdictRow> read_verdicts(const std::filesystem::path& file);

/// Adds rows to a table, each at once on the disk.
class VerdictWriter {
 public:
  /// Keeps `known`, drops what else was there. Throws WriteError.
  VerdictWriter(const std::filesystem::path& file, const std::vector<VerdictRow>& known);
  void append(const VerdictRow& row);

 private:
  Descriptor file_;
};

}  // namespace porosph
