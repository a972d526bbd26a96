#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/history_csv.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> columns{"time", "A.EffectiveStress_YY", "A.PorePressure"};

using Row = std::vector<double>;

History history_from(const TemporaryFolder& folder, const std::string& text) {
  put(folder / "history.csv", text);
  return read_history(folder / "history.csv").history;
}

}  // namespace

TEST_CASE("a history comes back bit for bit") {
  const TemporaryFolder folder;
  History history{columns, {{0, -0.0, 0.1}, {1e-300, 1.0 / 3, -1e308}}};
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) history.rows.push_back({static_cast<double>(i + 1), value, -value});
  }
  write_history(folder / "history.csv", history);
  const auto read = read_history(folder / "history.csv");
  CHECK(read.history.columns == columns);
  CHECK_FALSE(read.torn_line);
  REQUIRE(read.history.rows.size() == history.rows.size());
  for (std::size_t i = 0; i < history.rows.size(); ++i) {
    CHECK(std::memcmp(read.history.rows[i].data(), history.rows[i].data(), 3 * sizeof(double)) == 0);
  }
}

TEST_CASE("the file is plain: names, then numbers") {
  const TemporaryFolder folder;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  write_history(folder / "history.csv", {columns, {{0, 0.5, -std::nan("")}, {0.25, infinity, -infinity}}});
  CHECK(content(folder / "history.csv") ==
        "time,A.EffectiveStress_YY,A.PorePressure\n0,0.5,nan\n0.25,inf,-inf\n");
  const auto rows = read_history(folder / "history.csv").history.rows;
  CHECK(std::isnan(rows[0][2]));
  CHECK(rows[1] == Row{0.25, infinity, -infinity});
}

TEST_CASE("appended rows are in the file after a flush, and at the latest at the end") {
  const TemporaryFolder folder;
  const auto file = folder / "history.csv";
  {
    HistoryWriter writer(file, columns);
    CHECK(read_history(file).history.rows.empty());
    writer.append(Row{0, 1, 2});
    writer.append(Row{1, 2, 3});
    writer.flush();
    CHECK(read_history(file).history.rows.size() == 2);
    writer.append(Row{2, 3, 4});
  }
  CHECK(read_history(file).history.rows == std::vector<Row>{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}});
}

TEST_CASE("a long run needs no flush: blocks of whole rows arrive") {
  const TemporaryFolder folder;
  const auto file = folder / "history.csv";
  HistoryWriter writer(file, columns);
  for (int i = 0; i < 5000; ++i) writer.append(Row{i * 0.1, i / 3.0, i / 7.0});
  const auto read = read_history(file);
  CHECK_FALSE(read.torn_line);
  CHECK(read.history.rows.size() > 1000);
}

TEST_CASE("a row is as wide as the header") {
  const TemporaryFolder folder;
  HistoryWriter writer(folder / "history.csv", columns);
  CHECK_THROWS_WITH(writer.append(Row{0, 1}), Contains("2 numbers for 3 columns"));
  CHECK_THROWS_AS(write_history(folder / "other.csv", {columns, {{1.0}}}), std::invalid_argument);
}

TEST_CASE("column names that the format cannot hold are refused") {
  const TemporaryFolder folder;
  for (const auto& bad : {std::vector<std::string>{},
                          {"t"},
                          {"time", ""},
                          {"time", "a,b"},
                          {"time", "a\nb"},
                          {"time", "a\"b"},
                          {"time", "a", "a"}}) {
    CHECK_THROWS_AS(HistoryWriter(folder / "history.csv", bad), std::invalid_argument);
  }
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("on a full disk a flush fails, and the file still ends with a whole row") {
  const TemporaryFolder folder;
  const auto file = folder / "history.csv";
  HistoryWriter writer(file, columns);
  writer.append(Row{0, 1, 2});
  writer.flush();
  {
    const FileSizeLimit limit(1000);
    for (int i = 1; i < 100; ++i) writer.append(Row{i * 1.0, 1 / 3.0, 1 / 7.0});
    CHECK_THROWS_WITH(writer.flush(), Contains("history.csv") && Contains("File too large"));
  }
  CHECK(content(file) == "time,A.EffectiveStress_YY,A.PorePressure\n0,1,2\n");
}

TEST_CASE("a history that vanished is missed at the next flush") {
  const TemporaryFolder folder;
  HistoryWriter writer(folder / "history.csv", columns);
  std::filesystem::remove(folder / "history.csv");
  writer.append(Row{0, 1, 2});
  CHECK_THROWS_WITH(writer.flush(), Contains("history.csv: it was removed"));
}

TEST_CASE("a resumed history continues after the given time") {
  const TemporaryFolder folder;
  const auto file = folder / "history.csv";
  std::uint32_t checksum_up_to_there = 0;
  {
    HistoryWriter writer(file, columns);
    for (const Row& row : {Row{0, 1, 2}, Row{0.1, 1, 2}, Row{0.2, 1, 2}}) writer.append(row);
    checksum_up_to_there = writer.checksum();
    writer.append(Row{0.3, 1, 2});
  }
  put(file, content(file) + "0.4,1");
  {
    auto writer = HistoryWriter::resume(file, columns, 0.2, checksum_up_to_there);
    writer.append(Row{0.25, 3, 4});
  }
  const auto read = read_history(file);
  CHECK_FALSE(read.torn_line);
  CHECK(read.history.rows == std::vector<Row>{{0, 1, 2}, {0.1, 1, 2}, {0.2, 1, 2}, {0.25, 3, 4}});
  CHECK_THROWS_WITH(HistoryWriter::resume(file, columns, 0.22, checksum_up_to_there),
                    Contains("no row at 0.22 s"));
  CHECK_THROWS_WITH(HistoryWriter::resume(file, {"time", "B.PorePressure"}, 0.2, checksum_up_to_there),
                    Contains("columns"));
  CHECK_THROWS_AS(HistoryWriter::resume(folder / "none.csv", columns, 0, 0), ReadError);
}

TEST_CASE("a history that was changed is not resumed, and left as it is") {
  const TemporaryFolder folder;
  const auto file = folder / "history.csv";
  std::uint32_t checksum = 0;
  {
    HistoryWriter writer(file, columns);
    for (const Row& row : {Row{0, 1, 2}, Row{0.1, 1, 2}, Row{0.2, 1, 2}}) writer.append(row);
    checksum = writer.checksum();
  }
  const std::string sound = content(file);
  const auto check_refused = [&](const std::string& changed) {
    CAPTURE(changed);
    REQUIRE(changed != sound);
    put(file, changed);
    CHECK_THROWS_AS(HistoryWriter::resume(file, columns, 0.2, checksum), ReadError);
    CHECK(content(file) == changed);
  };
  for (const auto& [old, edited] : {std::pair{"0.10000000000000001,1,2\n", "0.10000000000000001,1,2.5\n"},
                                    {"0.10000000000000001,1,2\n", ""},  // a row that is missing
                                    {"0.10000000000000001,1,2\n", "0.05,1,2\n0.10000000000000001,1,2\n"},
                                    {"A.PorePressure", "A.Pressure"},
                                    {"0.20000000000000001,1,2\n", ""}}) {
    std::string changed = sound;
    changed.replace(changed.find(old), std::string(old).size(), edited);
    check_refused(changed);
  }
  put(file, sound);
  CHECK(HistoryWriter::resume(file, columns, 0.2, checksum).checksum() == checksum);
}

TEST_CASE("a file cut anywhere after its first line reads, and tells what was torn") {
  const TemporaryFolder folder;
  const std::string text = "time,a\n0,1.5\n0.25,2.5\n";
  for (std::size_t length = 7; length <= text.size(); ++length) {
    put(folder / "history.csv", text.substr(0, length));
    const auto read = read_history(folder / "history.csv");
    const auto whole_rows = static_cast<std::size_t>(length >= 13) + static_cast<std::size_t>(length >= 22);
    CHECK(read.history.rows.size() == whole_rows);
    CHECK(read.torn_line.has_value() == (text[length - 1] != '\n'));
  }
}

TEST_CASE("lines of other systems end with a carriage return, too") {
  const TemporaryFolder folder;
  CHECK(history_from(folder, "time,a\r\n0,1\r\n").rows == std::vector<Row>{{0, 1}});
}

TEST_CASE("a bad history is refused with its line and column") {
  const TemporaryFolder folder;
  const auto reading = [&](const std::string& text) { return history_from(folder, text); };
  CHECK_THROWS_WITH(reading(""), Contains("history.csv: line 1") && Contains("column names"));
  CHECK_THROWS_WITH(reading("time,a"), Contains("line 1") && Contains("torn"));
  CHECK_THROWS_WITH(reading("a,time\n"), Contains("line 1") && Contains("first column must be 'time'"));
  CHECK_THROWS_WITH(reading("time,a,a\n"), Contains("line 1: column 3: 'a' occurs twice"));
  CHECK_THROWS_WITH(reading("time,a\n0,1\n1,x\n"), Contains("line 3: column 2 (a): 'x' is not a number"));
  CHECK_THROWS_WITH(reading("time,a\n0,\n"), Contains("line 2: column 2 (a): '' is not a number"));
  CHECK_THROWS_WITH(reading("time,a\n0,1 \n"), Contains("'1 ' is not a number"));
  CHECK_THROWS_WITH(reading("time,a\n0,1e999\n"), Contains("'1e999' is not a number"));
  CHECK_THROWS_WITH(reading("time,a\n0,1,2\n"), Contains("line 2: 3 values for 2 columns"));
  CHECK_THROWS_WITH(reading("time,a\n0,1\n\n"), Contains("line 3: 1 values for 2 columns"));
  CHECK_THROWS_WITH(reading("time,a\n1,1\n0.5,1\n"), Contains("line 3: column 1 (time): earlier"));
  CHECK_THROWS_WITH(reading("time,a\n1,1\nnan,1\n"), Contains("line 3: column 1 (time)"));
}
