// The keys of a case as `--set` names them.
#pragma once

#include <string>
#include <vector>

namespace porosph {

/// "particles.spacing", "soil.0.youngs_modulus", ...: every key, tables of a list by the number 0. `values`
/// holds what may stand there, where that is one of a few words.
struct CaseKey {
  std::string path;
  std::vector<std::string> values;
};

/// In the order of the documents.
std::vector<CaseKey> case_keys();

}  // namespace porosph
