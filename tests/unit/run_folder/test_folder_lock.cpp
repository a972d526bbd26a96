#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <optional>

#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"

using namespace porosph;
namespace fs = std::filesystem;

TEST_CASE("a folder has one owner at a time, and none afterwards") {
  const fs::path folder = fs::temp_directory_path() / "porosph_lock_test";
  fs::remove_all(folder);
  std::optional<FolderLock> first(folder);
  CHECK_THROWS_AS(FolderLock(folder), WriteError);
  CHECK_THROWS_WITH(FolderLock(folder), Catch::Contains("another process computes into it"));
  std::ofstream(folder / "file") << "kept";
  first.reset();
  CHECK(fs::exists(folder / "file"));
  { const FolderLock second(folder); }
  CHECK(fs::exists(folder));

  fs::remove_all(folder);
  { const FolderLock third(folder); }
  CHECK_FALSE(fs::exists(folder));  // nothing came of it
}
