// The cases that come with the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace porosph::app {

struct ShippedCase {
  std::string name;  ///< "foundation", "verification/column"
  std::string title;
  std::filesystem::path file;
};

/// In the order of their names, those in folders last; other TOML files between them are left out. Empty
/// where the program was taken out of its installation. They lie in ../share/porosph/cases of the program.
std::vector<ShippedCase> shipped_cases();

/// The file that a command line means: itself, or the shipped case of that name where there is no such file.
std::filesystem::path find_case(const std::string& argument);

}  // namespace porosph::app
