// The keys of a case as `--set` names them.
#pragma once

#include <string>
#include <vector>

namespace porosph {

/// "particles.spacing", "soil.0.youngs_modulus", ...: every key, tables of a list by the number 0. `values`
/// holds what may stand there, where that is one of a few words.
struct CaseKey {
  std::string path, unit;  ///< unit "": none
  std::vector<std::string> values;
};

/// In the order of the documents.
std::vector<CaseKey> case_keys();

/// "m", "Pa", or "-" where it has none: of a key in which tables of a list may have their names or any
/// number, "soil.clay.cohesion".
std::string unit_of_key(const std::string& path);

}  // namespace porosph
