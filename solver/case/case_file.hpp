// case.toml <-> Case. The reference of all keys is docs/case-format.md.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// What is wrong with a case: every error found, one per line, each
/// "file:line:column: key 'soil[0].youngs_modulus' = -3: must be > 0 Pa".
/// Errors that an override brings name the override ("--set key=value") in place of file, line and column.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The checked case of a TOML file. Overrides are "key=value": the key is a dotted path such as
/// "particles.spacing", "soil.0.youngs_modulus" or "soil.sand.youngs_modulus", the value is TOML or a bare
/// word; arrays are replaced as a whole, the last override of a key wins. Throws CaseError.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// As read_case, from text; `file_name` is what the errors call it.
Case parse_case(std::string_view text, std::string_view file_name,
                const std::vector<std::string>& overrides = {});

/// The complete case as TOML, defaults filled in, units in comments. parse_case gives the same case back, bit
/// for bit.
std::string write_case(const Case& scene);

/// Markdown tables of every key: type, unit, default, what is allowed, meaning.
std::string describe_case_format();

/// The settings that a case has when it gives `motion` alone: the artificial terms of the paper's forms,
/// or the per-particle ones of the consistent form.
FormulationCase default_formulation(Motion motion);

/// The name of an arrangement in case files ("surface").
std::string_view arrangement_name(Arrangement arrangement);

/// The name of a momentum form in case files ("consistent").
std::string_view law_name(LawKind law);
std::string_view motion_name(Motion motion);

}  // namespace porosph
