// A case to start from: every key explained.
#pragma once

#include <string>
#include <string_view>

namespace porosph {

/// The case of `text` (TOML) with the meaning, unit and range of each key above it. Keys that `text` does not
/// give stand as comments with their defaults. Tables of a list are explained once. Reading the result gives
/// the same case as `text`. Throws CaseError.
std::string commented_case(std::string_view text);

}  // namespace porosph
