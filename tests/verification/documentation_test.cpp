// Whether docs/verification.md knows every case.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "solver/case/case_file.hpp"

using namespace porosph;

TEST_CASE("every verification case is in the table, and can be run") {
  const std::filesystem::path root = POROSPH_SOURCE_DIR;
  std::ifstream file(root / "docs/verification.md");
  REQUIRE(file);
  const std::string table{std::istreambuf_iterator<char>(file), {}};
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "cases/verification")) {
    const std::string name = "cases/verification/" + entry.path().filename().string();
    INFO(name);
    CHECK(table.find("porosph run " + name) != std::string::npos);
    CHECK_NOTHROW(read_case(entry.path()));
    ++cases;
  }
  CHECK(cases > 0);
}
