#include <catch2/catch.hpp>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

TEST_CASE("a file is written, replaced and read back, bytes as they are") {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder / "file", "older and longer than the new one");
  write_file(folder / "file", bytes);
  CHECK(content(folder / "file") == bytes);
  CHECK(read_file(folder / "file") == bytes);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"file"});
}

TEST_CASE("an empty file is written and read back") {
  const TemporaryFolder folder;
  write_file(folder / "file", "");
  CHECK(read_file(folder / "file").empty());
}

TEST_CASE("a temporary left by a killed job does no harm") {
  const TemporaryFolder folder;
  put(folder / ".file.part", "left over");
  write_file(folder / "file", "new");
  CHECK(content(folder / "file") == "new");
  CHECK(names_in(folder.path()).size() == 1);
}

TEST_CASE("on a full disk the old file stays and the temporary goes") {
  const TemporaryFolder folder;
  write_file(folder / "file", "old");
  {
    const FileSizeLimit limit(1000);
    CHECK_THROWS_WITH(write_file(folder / "file", std::string(5000, 'x')),
                      Contains((folder / "file").string()) && Contains("File too large"));
  }
  CHECK(content(folder / "file") == "old");
  CHECK(names_in(folder.path()).size() == 1);
}

TEST_CASE("if what fills the temporary throws, the old file stays and the temporary goes") {
  const TemporaryFolder folder;
  write_file(folder / "file", "old");
  const auto fill = [](const std::filesystem::path& temporary) {
    put(temporary, "half");
    throw std::domain_error("other half missing");
  };
  CHECK_THROWS_AS(replace_file(folder / "file", fill), std::domain_error);
  CHECK(content(folder / "file") == "old");
  CHECK(names_in(folder.path()).size() == 1);
}

TEST_CASE("a folder without permission, a missing folder and a folder in the file's place are WriteErrors") {
  const TemporaryFolder folder;
  {
    const ReadOnly read_only(folder.path());
    CHECK_THROWS_WITH(write_file(folder / "file", "x"), Contains("Permission denied"));
    CHECK_THROWS_AS(make_folder(folder / "below"), WriteError);
  }
  CHECK_THROWS_WITH(write_file(folder / "none/file", "x"), Contains("No such file or directory"));
  make_folder(folder / "taken/below");
  CHECK_THROWS_AS(write_file(folder / "taken", "x"), WriteError);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"taken"});
}

TEST_CASE("reading what is missing or a folder is a ReadError") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder / "none"), Contains("none: No such file or directory"));
  CHECK_THROWS_AS(read_file(folder.path()), ReadError);
}
