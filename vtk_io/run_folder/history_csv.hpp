// history.csv: probe readings over time as comma-separated values, first line the column names.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "vtk_io/run_folder/checksum.hpp"
#include "vtk_io/run_folder/descriptor.hpp"

namespace porosph {

/// Numbers have 17 significant digits: reading gives the same doubles. NaN and infinities are nan, inf, -inf.
/// Column names must not be empty, hold commas, quotes or line breaks, or occur twice; the first is "time".
/// Throws std::invalid_argument if `history` breaks this, WriteError otherwise.
void write_history(const std::filesystem::path& file, const History& history);

struct HistoryFile {
  History history;
  std::optional<std::string> torn_line;  ///< what a killed job left of its last row: no line break after it
};

/// Rows must have one number per column, and times must not decrease.
/// Throws ReadError that names file, line and column. A torn last line is left out and reported.
HistoryFile read_history(const std::filesystem::path& file);

/// Rows arrive at the file in blocks of whole rows: one second or 64 KiB apart, on flush() and at the end.
class HistoryWriter {
 public:
  /// Replaces `file` by one with no rows. Throws as write_history.
  HistoryWriter(const std::filesystem::path& file, const std::vector<std::string>& columns);

  /// Continues `file` after its row at `time` [s]: later rows and a torn last line are dropped. Throws
  /// ReadError, also if there is no such row, its columns are not these, or the rest has another checksum
  /// than this; WriteError.
  static HistoryWriter resume(const std::filesystem::path& file, const std::vector<std::string>& columns,
                              double time, std::uint32_t checksum);

  HistoryWriter(HistoryWriter&&) = default;
  HistoryWriter& operator=(HistoryWriter&&) = delete;
  ~HistoryWriter();  ///< flushes; call flush() first to learn of errors

  /// One number per column. Throws std::invalid_argument, WriteError.
  void append(std::span<const double> row);
  /// All rows so far to the file. If that fails the file ends with its last whole row. Throws WriteError.
  void flush();
  /// As flush(), and waits until the disk has them. Throws WriteError, as flush() also if the file was
  /// removed.
  void sync();
  /// Of the column names and all rows so far, as text.
  std::uint32_t checksum() const { return checksum_.value(); }

 private:
  HistoryWriter(const std::filesystem::path& file, const History& history);
  std::size_t columns_;
  Checksum checksum_;
  Descriptor file_;
  std::string pending_;
  std::chrono::steady_clock::time_point last_flush_ = std::chrono::steady_clock::now();
};

}  // namespace porosph
