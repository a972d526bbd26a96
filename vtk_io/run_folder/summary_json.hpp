// summary.json: how a run went, for people, CI and other programs.
#pragma once

#include <filesystem>

#include "solver/output/frame.hpp"

namespace porosph {

/// Keys are the names of Summary's members. A number that is not finite is null, with the reason in
/// "<key>_reason" beside it. `errors` is there only if the case names a reference. Throws WriteError.
void write_summary(const std::filesystem::path& file, const Summary& summary);

/// Keys that Summary does not know are passed over; a missing one or one of the wrong type is an error.
/// Throws ReadError that names file, key and what is allowed.
Summary read_summary(const std::filesystem::path& file);

}  // namespace porosph
