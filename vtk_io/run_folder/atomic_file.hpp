// Files that are either the old one or the complete new one, never something in between.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace porosph {

/// Calls `fill` with the path of a temporary beside `file`, then puts what it wrote in the place of `file`.
/// The data are on disk before the name changes. If anything fails the temporary is removed and `file` is as
/// it was. Throws WriteError naming `file`; what `fill` throws passes through.
void replace_file(const std::filesystem::path& file,
                  const std::function<void(const std::filesystem::path& temporary)>& fill);

/// As replace_file, with these bytes.
void write_file(const std::filesystem::path& file, std::string_view content);

/// Makes the folder and those above it; false if it was there. Throws WriteError.
bool make_folder(const std::filesystem::path& folder);

/// The whole file. Throws ReadError.
std::string read_file(const std::filesystem::path& file);

}  // namespace porosph
