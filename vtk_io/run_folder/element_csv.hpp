// The table of element tests.
#pragma once

#include <string>
#include <vector>

#include "solver/element/element_test.hpp"

namespace porosph {

/// One specimen of a soil in a test.
struct ElementRun {
  std::string soil;
  ElementPath path;
};

/// "100 kPa", with the axial stress where it differs; names the soil where there are several.
std::string label_of(const ElementRun& run, bool with_soil);

/// One row per step in SI units, compression positive; what a soil's law does not remember is empty.
std::string element_csv(const std::vector<ElementRun>& runs);

}  // namespace porosph
