#include "vtk_io/run_folder/history_csv.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "vtk_io/run_folder/atomic_file.hpp"
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
    if (std::isnan(row[i])) {
      text += "nan";  // without the sign bit, which says nothing
    } else {
      fmt::format_to(std::back_inserter(text), "{:.17g}", row[i]);
    }
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

/// The cells of a line, or of any text between commas.
std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (auto comma = line.find(','); comma != line.npos; comma = line.find(',')) {
    cells.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  cells.push_back(line);
  return cells;
}

/// Reads line after line and knows where it is, for the messages.
class Reader {
 public:
  Reader(const std::filesystem::path& file, std::string_view text) : file_(file), rest_(text) {}

  HistoryFile read() {
    const auto first = next_line();
    if (!first) fail("the line of column names is missing or torn");
    for (const auto name : split(*first)) result_.history.columns.emplace_back(name);
    if (const auto fault = fault_of(result_.history.columns); !fault.empty()) fail(fault);
    while (const auto line = next_line()) add_row(split(*line));
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

  void add_row(const std::vector<std::string_view>& cells) {
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
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size()) {
      fail(fmt::format("column {} ({}): '{}' is not a number", column + 1, result_.history.columns[column],
                       cell));
    }
    return value;
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

void write_history(const std::filesystem::path& file, const History& history) {
  if (const auto fault = fault_of(history.columns); !fault.empty())
    throw std::invalid_argument("history: " + fault);
  auto text = header(history.columns);
  for (const auto& row : history.rows) {
    check_row(row.size(), history.columns.size());
    append_row(text, row);
  }
  write_file(file, text);
}

HistoryFile read_history(const std::filesystem::path& file) { return Reader(file, read_file(file)).read(); }

HistoryWriter::HistoryWriter(const std::filesystem::path& file, std::size_t columns)
    : columns_(columns), file_(file, O_WRONLY | O_APPEND, file) {}

HistoryWriter::HistoryWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : HistoryWriter((write_history(file, {columns, {}}), file), columns.size()) {}

HistoryWriter HistoryWriter::resume(const std::filesystem::path& file,
                                    const std::vector<std::string>& columns, double time) {
  auto history = read_history(file).history;
  if (history.columns != columns) {
    throw ReadError(file, "its columns are not those of the case: cannot be continued");
  }
  std::erase_if(history.rows, [&](const auto& row) { return row[0] > time; });
  if (history.rows.empty() || history.rows.back()[0] != time) {
    throw ReadError(file, fmt::format("it has no row at {} s: cannot be continued from there", time));
  }
  write_history(file, history);
  return HistoryWriter(file, columns.size());
}

HistoryWriter::~HistoryWriter() {
  try {
    flush();
  } catch (const WriteError&) {  // flush() tells; a destructor cannot
  }
}

void HistoryWriter::append(std::span<const double> row) {
  check_row(row.size(), columns_);
  append_row(pending_, row);
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
