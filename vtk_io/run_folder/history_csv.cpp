#include "vtk_io/run_folder/history_csv.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "solver/printable.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace {

constexpr std::size_t block_bytes = 64 * 1024;
constexpr std::chrono::seconds block_time{1};

/// What is wrong with these column names; empty if nothing is.
std::string fault_of(const std::vector<std::string>& columns) {
  if (columns.empty() || columns.front() != "time") return "the first column must be 'time'";
  std::set<std::string> seen;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& name = columns[i];
    if (name.empty()) return fmt::format("column {} has no name", i + 1);
    if (name.find_first_of(",\"\r\n") != std::string::npos) {
      return fmt::format("column {}: the name must not hold commas, quotes or line breaks", i + 1);
    }
    if (const auto control = control_character(name); !control.empty()) {
      return fmt::format("column {}: the name must not hold control characters, but has {}", i + 1, control);
    }
    if (!seen.insert(name).second) return fmt::format("column {}: '{}' occurs twice", i + 1, name);
  }
  return {};
}

std::string header(const std::vector<std::string>& columns) {
  return fmt::format("{}\n", fmt::join(columns, ","));
}

void append_row(std::string& text, std::span<const double> row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) text += ',';
    append_csv_number(text, row[i]);
  }
  text += '\n';
}

void check_row(std::size_t numbers, std::size_t columns) {
  if (numbers != columns) {
    throw std::invalid_argument(fmt::format("a history row has {} numbers for {} columns", numbers, columns));
  }
}

std::string_view without_carriage_return(std::string_view line) {
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

/// Reads line after line and knows where it is, for the messages.
class Reader {
 public:
  Reader(const std::filesystem::path& file, std::string_view text) : file_(file), rest_(text) {}

  HistoryFile read() {
    const auto first = next_line();
    if (!first) fail("the line of column names is missing or torn");
    result_.history.columns = cells_of(*first);
    if (const auto fault = fault_of(result_.history.columns); !fault.empty()) fail(fault);
    while (const auto line = next_line()) add_row(cells_of(*line));
    if (!rest_.empty()) result_.torn_line = rest_;
    return std::move(result_);
  }

 private:
  std::optional<std::string_view> next_line() {
    const auto end = rest_.find('\n');
    if (end == rest_.npos) return std::nullopt;
    const auto line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    ++line_;
    return without_carriage_return(line);
  }

  std::vector<std::string> cells_of(std::string_view line) const {
    try {
      return csv_cells(line);
    } catch (const std::invalid_argument& fault) {
      fail(fault.what());
    }
  }

  void add_row(const std::vector<std::string>& cells) {
    const auto& columns = result_.history.columns;
    auto& rows = result_.history.rows;
    if (cells.size() != columns.size()) {
      fail(fmt::format("{} values for {} columns", cells.size(), columns.size()));
    }
    std::vector<double> row(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) row[i] = number(cells[i], i);
    if (!rows.empty() && !(row[0] >= rows.back()[0])) {
      fail("column 1 (time): earlier than the row before, or not a time");
    }
    rows.push_back(std::move(row));
  }

  double number(std::string_view cell, std::size_t column) const {
    try {
      return csv_number(cell);
    } catch (const std::invalid_argument& fault) {
      fail(fmt::format("column {} ({}): {}", column + 1, result_.history.columns[column], fault.what()));
    }
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw ReadError(file_, fmt::format("line {}: {}", std::max(line_, 1), reason));
  }

  const std::filesystem::path& file_;
  std::string_view rest_;
  int line_ = 0;
  HistoryFile result_;
};

}  // namespace

namespace {

std::string text_of(const History& history) {
  if (const auto fault = fault_of(history.columns); !fault.empty())
    throw std::invalid_argument("history: " + fault);
  auto text = header(history.columns);
  for (const auto& row : history.rows) {
    check_row(row.size(), history.columns.size());
    append_row(text, row);
  }
  return text;
}

}  // namespace

void write_history(const std::filesystem::path& file, const History& history) {
  write_file(file, text_of(history));
}

HistoryFile read_history(const std::filesystem::path& file) { return Reader(file, read_file(file)).read(); }

HistoryWriter::HistoryWriter(const std::filesystem::path& file, const History& history)
    : columns_(history.columns.size()),
      file_((write_history(file, history), file), O_WRONLY | O_APPEND, file) {
  checksum_.add(text_of(history));
}

HistoryWriter::HistoryWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : HistoryWriter(file, History{columns, {}}) {}

HistoryWriter HistoryWriter::resume(const std::filesystem::path& file,
                                    const std::vector<std::string>& columns, double time,
                                    std::uint32_t checksum) {
  auto history = read_history(file).history;
  if (history.columns != columns) {
    throw ReadError(file, "its columns are not those of the case");
  }
  std::erase_if(history.rows, [&](const auto& row) { return row[0] > time; });
  if (history.rows.empty() || history.rows.back()[0] != time) {
    throw ReadError(file, fmt::format("it has no row at {} s", time));
  }
  Checksum found;
  found.add(text_of(history));
  if (found.value() != checksum) {
    throw ReadError(file, fmt::format("its rows up to {} s are not those that the run wrote", time));
  }
  return HistoryWriter(file, history);
}

HistoryWriter::~HistoryWriter() {
  try {
    flush();
  } catch (const WriteError&) {  // flush() tells; a destructor cannot
  }
}

void HistoryWriter::append(std::span<const double> row) {
  check_row(row.size(), columns_);
  const auto before = pending_.size();
  append_row(pending_, row);
  checksum_.add(std::string_view(pending_).substr(before));
  if (pending_.size() >= block_bytes || std::chrono::steady_clock::now() - last_flush_ >= block_time) flush();
}

void HistoryWriter::flush() {
  const auto size = file_.size();
  try {
    file_.write(std::exchange(pending_, {}));
  } catch (const WriteError&) {
    file_.truncate(size);
    throw;
  }
  last_flush_ = std::chrono::steady_clock::now();
}

void HistoryWriter::sync() {
  flush();
  file_.sync();
}

}  // namespace porosph
