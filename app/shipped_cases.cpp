#include "app/shipped_cases.hpp"

#include <algorithm>
#include <optional>
#include <system_error>

#include "solver/case/case_file.hpp"

namespace porosph::app {
namespace fs = std::filesystem;

namespace {

fs::path cases_folder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return program.parent_path().parent_path() / "share/porosph/cases";
}

/// Nothing where the file is not a case.
std::optional<std::string> title_of(const fs::path& file) {
  try {
    return read_case(file).title;
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<ShippedCase> shipped_cases() {
  std::vector<ShippedCase> cases;
  std::error_code none;  // no such folder: no cases
  const fs::path folder = cases_folder();
  const auto follow = fs::directory_options::follow_directory_symlink;
  for (const auto& entry : fs::recursive_directory_iterator(folder, follow, none)) {
    if (entry.path().extension() != ".toml") continue;
    const fs::path name = entry.path().lexically_relative(folder).replace_extension();
    if (const auto title = title_of(entry.path()))
      cases.push_back({name.generic_string(), *title, entry.path()});
  }
  std::ranges::sort(cases, {},
                    [](const ShippedCase& c) { return std::pair(std::ranges::count(c.name, '/'), c.name); });
  return cases;
}

fs::path find_case(const std::string& argument) {
  std::error_code none;
  if (!fs::exists(argument, none))
    for (const ShippedCase& c : shipped_cases())
      if (c.name == argument) return c.file;
  return argument;
}

}  // namespace porosph::app
