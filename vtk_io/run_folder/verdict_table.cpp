#include "vtk_io/run_folder/verdict_table.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace {

constexpr std::string_view head =
    "x,y,class,cause,time,steps,error,unbalanced_force_ratio,energy_growth,fingerprint,message\n";
constexpr std::size_t columns = 11;

std::string number(double value) {
  std::string text;
  if (std::isfinite(value)) append_csv_number(text, value);
  return text;
}

std::string line(const VerdictRow& row) {
  const Verdict& v = row.verdict;
  return csv_line({row.x, row.y, std::string(class_name(v.outcome)), v.cause, number(v.time),
                   fmt::to_string(v.steps), number(v.error), number(v.unbalanced), number(v.energy_growth),
                   row.fingerprint, v.message});
}

class RowParser {
 public:
  RowParser(const std::filesystem::path& file, std::size_t line) : file_(file), line_(line) {}

  VerdictRow parse(const std::string& text) const {
    const std::vector<std::string> f = fields(text);
    if (f.size() != columns) fail(fmt::format("has {} fields instead of {}", f.size(), columns));
    VerdictRow row{f[0], f[1], f[9], {}};
    row.verdict = {.outcome = parsed_class(f[2]),
                   .cause = f[3],
                   .time = parsed_or_none(f[4]),
                   .steps = parsed_count(f[5]),
                   .error = parsed_or_none(f[6]),
                   .unbalanced = parsed_or_none(f[7]),
                   .energy_growth = parsed_or_none(f[8]),
                   .message = f[10]};
    return row;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ReadError(file_, fmt::format("line {}: {}", line_, what));
  }
  std::vector<std::string> fields(const std::string& text) const {
    try {
      return csv_cells(text);
    } catch (const std::invalid_argument& fault) {
      fail(fault.what());
    }
  }
  double parsed(const std::string& text) const {
    try {
      return csv_number(text);
    } catch (const std::invalid_argument& fault) {
      fail(fault.what());
    }
  }
  double parsed_or_none(const std::string& text) const { return text.empty() ? std::nan("") : parsed(text); }
  std::int64_t parsed_count(const std::string& text) const {
    const double value = parsed(text);
    if (!(value >= 0 && value < 9e15 && value == std::floor(value)))
      fail(fmt::format("'{}' is not a whole number", text));
    return static_cast<std::int64_t>(value);
  }
  StabilityClass parsed_class(const std::string& name) const {
    for (int c = 0; c < stability_classes; ++c)
      if (class_name(static_cast<StabilityClass>(c)) == name) return static_cast<StabilityClass>(c);
    fail(fmt::format("'{}' is not a class", name));
  }

  const std::filesystem::path& file_;
  std::size_t line_;
};

}  // namespace

void write_verdicts(const std::filesystem::path& file, const std::vector<VerdictRow>& rows) {
  std::string text(head);
  for (const VerdictRow& row : rows) text += line(row);
  write_file(file, text);
}

std::vector<VerdictRow> read_verdicts(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  if (!text.starts_with(head)) throw ReadError(file, "it is not a table of verdicts");
  std::vector<VerdictRow> rows;
  std::size_t number = 2;
  for (std::size_t from = head.size(), end; (end = text.find('\n', from)) != std::string::npos;
       from = end + 1)
    rows.push_back(RowParser(file, number++).parse(text.substr(from, end - from)));
  return rows;
}

VerdictWriter::VerdictWriter(const std::filesystem::path& file, const std::vector<VerdictRow>& known)
    : file_((write_verdicts(file, known), file), O_WRONLY | O_APPEND, file) {}

void VerdictWriter::append(const VerdictRow& row) { file_.write(line(row)); }

}  // namespace porosph
