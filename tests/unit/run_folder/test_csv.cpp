#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "vtk_io/run_folder/csv.hpp"

using namespace porosph;
using Cells = std::vector<std::string>;

TEST_CASE("cells come back as they were written") {
  for (const Cells& cells :
       {Cells{"time", "A.PorePressure"}, Cells{""}, Cells{"", ""}, Cells{"", "b", ""},
        Cells{"a,b", "say \"x\"", "\"", "\"\"", ",", "x\"y"}, Cells{"Böschung", " blank "}}) {
    const std::string line = csv_line(cells);
    CAPTURE(line);
    REQUIRE(line.ends_with('\n'));
    CHECK(csv_cells(line.substr(0, line.size() - 1)) == cells);
  }
  CHECK(csv_line({"a\nb", "\x1b"}) == "a[U+000A]b,[U+001B]\n");
}

TEST_CASE("quotes in wrong places are refused") {
  for (const char* line : {"\"", "\"a", "a,\"b", "\"a\"b,c", "\"a\"\"", "\"a\" ,b"})
    CHECK_THROWS_AS(csv_cells(line), std::invalid_argument);
  CHECK(csv_cells("a\"b,c") == Cells{"a\"b", "c"});
}

TEST_CASE("numbers come back to the last bit, and nothing else is a number") {
  for (const double value :
       {0.1, -1. / 3, 1e-310, 1.7976931348623157e308, -0.0, std::numeric_limits<double>::infinity()}) {
    std::string text;
    append_csv_number(text, value);
    CHECK(csv_number(text) == value);
    CHECK(std::signbit(csv_number(text)) == std::signbit(value));
  }
  std::string nan;
  append_csv_number(nan, -std::nan(""));
  CHECK(nan == "nan");
  for (const char* text : {"", " 1", "1 ", "0x1p3", "1,5", "one"})
    CHECK_THROWS_AS(csv_number(text), std::invalid_argument);
}
